#include "bendlab/mesh/surface_values.hpp"

#include <fmt/format.h>
#ifdef BENDLAB_WITH_PNG
#include <png.h>
#endif

#include <cmath>
#include <cstring>

#include "bendlab/mesh/box_tree.hpp"
#include "bendlab/mesh/files.hpp"
#include "bendlab/mesh/mesh_surface.hpp"
#include "bendlab/mesh/readers.hpp"
#include "bendlab/settings/input_file.hpp"

namespace bendlab {
namespace {

[[noreturn]] void refuse_map(MeshFileError::Kind kind, const std::filesystem::path& file,
                             std::string_view what) {
  throw MeshFileError(kind, fmt::format("map file '{}': {}", file.string(), what));
}

std::string bytes_of_map(const std::filesystem::path& file) try {
  return read_input_file(file);
} catch (const std::runtime_error& error) {
  refuse_map(MeshFileError::Kind::unreadable, file, error.what());
}

PlyValues values_in(const std::filesystem::path& file, std::string_view property) {
  const std::string bytes = bytes_of_map(file);
  try {
    return parse_ply_values(bytes, property);
  } catch (const std::invalid_argument& error) {
    refuse_map(MeshFileError::Kind::refused, file, error.what());
  }
}

}  // namespace

struct SurfaceValues::Data {
  PlyValues values;
  std::unique_ptr<BoxTree> tree;

  Vector3 point(std::int64_t v) const {
    const auto& p = values.soup.points[static_cast<std::size_t>(v)];
    return {p[0], p[1], p[2]};
  }
};

SurfaceValues::SurfaceValues(const std::filesystem::path& file, std::string_view property)
    : data_(std::make_unique<Data>()) {
  data_->values = values_in(file, property);
  const PolygonSoup& soup = data_->values.soup;
  const auto count = static_cast<std::int64_t>(soup.points.size());
  if (soup.triangles.empty()) refuse_map(MeshFileError::Kind::refused, file, "the file has no faces");
  Positions centres(static_cast<Eigen::Index>(soup.triangles.size()), 3);
  std::vector<Box> boxes(soup.triangles.size());
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    Vector3 centre = Vector3::Zero();
    for (const std::int64_t v : soup.triangles[t]) {
      if (v < 0 || v >= count)
        refuse_map(MeshFileError::Kind::refused, file, fmt::format("face {} has no such point: {}", t, v));
      if (!is_finite(soup.points[static_cast<std::size_t>(v)]))
        refuse_map(MeshFileError::Kind::refused, file, fmt::format("point {} is not finite", v));
      centre += data_->point(v) / 3;
      boxes[t].include(Box::around(data_->point(v)));
    }
    centres.row(static_cast<Eigen::Index>(t)) = centre.transpose();
  }
  data_->tree = std::make_unique<BoxTree>(centres);
  data_->tree->renew(boxes);
}

SurfaceValues::~SurfaceValues() = default;

SurfaceValues::At SurfaceValues::operator()(const Vector3& place) const {
  const PlyValues& values = data_->values;
  double least = std::numeric_limits<double>::infinity();
  At at{0, least};
  data_->tree->least_squared_distance(place, [&](int element) {
    const auto t = static_cast<std::size_t>(element);
    const auto& corner = values.soup.triangles[t];
    const std::array<Vector3, 3> p = {data_->point(corner[0]), data_->point(corner[1]),
                                      data_->point(corner[2])};
    const Vector3 weight = nearest_weights(place, p[0], p[1], p[2]);
    const double squared = (weight(0) * p[0] + weight(1) * p[1] + weight(2) * p[2] - place).squaredNorm();
    if (squared < least) {
      least = squared;
      at.value = values.of_triangles.empty() ? 0 : values.of_triangles[t];
      for (int c = 0; values.of_triangles.empty() && c < 3; ++c)
        at.value +=
            weight(c) * values.of_points[static_cast<std::size_t>(corner[static_cast<std::size_t>(c)])];
    }
    return squared;
  });
  at.distance = std::sqrt(least);
  return at;
}

#ifdef BENDLAB_WITH_PNG
namespace {

// What libpng reads from, and the text of its error.
struct PngInput {
  std::string_view left;
  std::string error;
};

extern "C" void read_png_bytes(png_structp png, png_bytep to, png_size_t count) {
  auto& input = *static_cast<PngInput*>(png_get_io_ptr(png));
  if (count > input.left.size()) png_error(png, "the file ends before its image");
  std::memcpy(to, input.left.data(), count);
  input.left.remove_prefix(count);
}

extern "C" void keep_png_error(png_structp png, png_const_charp text) {
  static_cast<PngInput*>(png_get_error_ptr(png))->error = text;
  longjmp(png_jmpbuf(png), 1);
}

extern "C" void ignore_png_warning(png_structp, png_const_charp) {}

// Reads the rows as 16-bit grey. All objects with a destructor belong to the caller, because libpng leaves
// this function by longjmp() if there is an error.
bool read_grey(png_structp png, png_infop info, std::vector<unsigned char>& bytes,
               std::vector<png_bytep>& rows, int& width, int& height) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_read_info(png, info);
  png_set_expand_16(png);
  png_set_strip_alpha(png);
  if ((png_get_color_type(png, info) & PNG_COLOR_MASK_COLOR) != 0) png_set_rgb_to_gray(png, 1, -1, -1);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  width = static_cast<int>(png_get_image_width(png, info));
  height = static_cast<int>(png_get_image_height(png, info));
  const std::size_t stride = png_get_rowbytes(png, info);
  bytes.resize(stride * static_cast<std::size_t>(height));
  rows.resize(static_cast<std::size_t>(height));
  for (std::size_t row = 0; row < rows.size(); ++row) rows[row] = &bytes[row * stride];
  png_read_image(png, rows.data());
  return true;
}

}  // namespace

GreyImage::GreyImage(const std::filesystem::path& file) {
  const std::string content = bytes_of_map(file);
  PngInput input{content, {}};
  if (png_sig_cmp(reinterpret_cast<png_const_bytep>(content.data()), 0,
                  std::min<std::size_t>(content.size(), 8)) != 0)
    refuse_map(MeshFileError::Kind::refused, file, "it is not a PNG image, although its name ends in .png");
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &input, keep_png_error, ignore_png_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  std::vector<unsigned char> bytes;
  std::vector<png_bytep> rows;
  bool done = false;
  if (info != nullptr) {
    png_set_read_fn(png, &input, read_png_bytes);
    constexpr png_uint_32 most = 16384;
    png_set_user_limits(png, most, most);
    done = read_grey(png, info, bytes, rows, width_, height_);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  if (!done) refuse_map(MeshFileError::Kind::refused, file, input.error);
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2)
    grey_.push_back(static_cast<float>(256 * bytes[i] + bytes[i + 1]) / 65535.0F);
}
#else
GreyImage::GreyImage(const std::filesystem::path& file) {
  refuse_map(
      MeshFileError::Kind::refused, file,
      "this library was built without libpng. Install libpng-dev and build it again, or give the map as "
      "a property of a PLY file");
}
#endif

double GreyImage::operator()(const Vector2& texture) const {
  const double x = texture.x() * width_ - 0.5, y = (1 - texture.y()) * height_ - 0.5;
  const auto at = [&](double column, double row) {
    const auto wrapped = [](double i, int count) {
      return static_cast<std::size_t>(i - count * std::floor(i / count));
    };
    return static_cast<double>(
        grey_[wrapped(row, height_) * static_cast<std::size_t>(width_) + wrapped(column, width_)]);
  };
  const double left = std::floor(x), top = std::floor(y), s = x - left, t = y - top;
  return (1 - t) * ((1 - s) * at(left, top) + s * at(left + 1, top)) +
         t * ((1 - s) * at(left, top + 1) + s * at(left + 1, top + 1));
}

}  // namespace bendlab
