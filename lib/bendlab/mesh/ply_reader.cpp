#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <stdexcept>

#include "bendlab/mesh/polygon_list.hpp"
#include "bendlab/mesh/readers.hpp"
#include "bendlab/mesh/text_lines.hpp"

namespace bendlab {
namespace {

template <class Number>
double read_number(std::string_view& bytes, bool swap) {
  std::array<char, sizeof(Number)> raw;
  if (bytes.size() < raw.size()) throw std::invalid_argument("the file ends before its last element");
  std::copy_n(bytes.begin(), raw.size(), raw.begin());
  bytes.remove_prefix(raw.size());
  if (swap) std::reverse(raw.begin(), raw.end());
  return static_cast<double>(std::bit_cast<Number>(raw));
}

struct Type {
  std::string_view name, alias;
  double (*read)(std::string_view& bytes, bool swap);  // removes the first number from `bytes`
};

constexpr std::array<Type, 8> types = {{{"char", "int8", read_number<std::int8_t>},
                                        {"uchar", "uint8", read_number<std::uint8_t>},
                                        {"short", "int16", read_number<std::int16_t>},
                                        {"ushort", "uint16", read_number<std::uint16_t>},
                                        {"int", "int32", read_number<std::int32_t>},
                                        {"uint", "uint32", read_number<std::uint32_t>},
                                        {"float", "float32", read_number<float>},
                                        {"double", "float64", read_number<double>}}};

struct Property {
  std::string_view name;
  const Type* type;
  const Type* count_type;  // type of a list's length; null if the property is not a list
};

struct Element {
  std::string_view name;
  std::size_t count;
  std::vector<Property> properties;
};

struct Header {
  std::string_view format;
  std::vector<Element> elements;
};

using ValueSource = std::function<double(const Type&)>;  // the file's next value

const Type* type_of(const TextLines& lines, std::size_t word) {
  for (const Type& type : types)
    if (lines.word(word) == type.name || lines.word(word) == type.alias) return &type;
  lines.fail(lines.quoted(word) + " is no PLY type");
}

Header read_header(TextLines& lines) {
  Header header;
  lines.need_next("'ply'");
  if (lines.word(0) != "ply") lines.fail("a PLY file starts with 'ply'");
  while (true) {
    lines.need_next("'end_header'");
    const std::string_view key = lines.word(0);
    if (key == "end_header") return header;
    if (key == "format") header.format = lines.word(1);
    if (key == "element") header.elements.push_back({lines.word(1), lines.count(2), {}});
    if (key != "property") continue;
    if (header.elements.empty()) lines.fail("a property comes before the first element");
    if (lines.word(1) == "list")
      header.elements.back().properties.push_back({lines.word(4), type_of(lines, 3), type_of(lines, 2)});
    else
      header.elements.back().properties.push_back({lines.word(2), type_of(lines, 1), nullptr});
  }
}

ValueSource text_source(TextLines& lines) {
  return [&lines, word = std::size_t{0}, words = std::size_t{0}](const Type&) mutable {
    if (word == words) {
      lines.need_next("its last element");
      word = 0, words = lines.word_count();
    }
    return lines.real(word++);
  };
}

ValueSource binary_source(std::string_view bytes, bool little_endian) {
  const bool swap = little_endian != (std::endian::native == std::endian::little);
  return [bytes, swap](const Type& type) mutable { return type.read(bytes, swap); };
}

std::int64_t whole(double value) {
  if (value != std::floor(value) || std::abs(value) > 0x1p53)
    throw std::invalid_argument(fmt::format("{} is not a whole number", value));
  return static_cast<std::int64_t>(value);
}

// Reads a property of a vertex, face or other item: a single value, or all values of a list.
void read_property(const Property& property, const ValueSource& next, std::vector<double>& values) {
  values.clear();
  const std::int64_t count = property.count_type ? whole(next(*property.count_type)) : 1;
  if (count < 0) throw std::invalid_argument(fmt::format("a list has {} values", count));
  for (std::int64_t i = 0; i < count; ++i) values.push_back(next(*property.type));
}

// The property that parse_ply_values() looks for, and where its values go.
struct Wanted {
  std::string_view property = {};
  std::vector<double> of_points, of_triangles;
};

void read_element(const Element& element, const ValueSource& next, PolygonSoup& soup, PolygonList& polygons,
                  Wanted& wanted) {
  if (element.properties.empty()) return;
  std::vector<double> values;
  std::vector<std::int64_t> corners;
  for (std::size_t item = 0; item < element.count; ++item) {
    std::array<double, 3> point{};
    double of_face = 0;
    const std::size_t triangles_before = soup.triangles.size();
    for (const Property& property : element.properties) {
      read_property(property, next, values);
      const bool is_wanted = property.name == wanted.property && !property.count_type;
      if (is_wanted && element.name == "vertex") wanted.of_points.push_back(values[0]);
      if (is_wanted && element.name == "face") of_face = values[0];
      const std::size_t axis = std::string_view("xyz").find(property.name);
      if (element.name == "vertex" && !property.count_type && property.name.size() == 1 && axis < 3)
        point[axis] = values[0];
      if (element.name != "face" || (property.name != "vertex_indices" && property.name != "vertex_index"))
        continue;
      corners.clear();
      for (const double value : values) corners.push_back(whole(value));
      polygons.add(corners, item);
    }
    if (element.name == "vertex") soup.points.push_back(point);
    if (element.name == "face" && !wanted.property.empty())
      wanted.of_triangles.resize(wanted.of_triangles.size() + soup.triangles.size() - triangles_before,
                                 of_face);
  }
}

// Throws if no point or face has the property, and lists the properties that they have.
void require_wanted(const Header& header, std::string_view wanted) {
  std::vector<std::string> known;
  for (const Element& element : header.elements)
    for (const Property& property : element.properties) {
      if (property.count_type || (element.name != "vertex" && element.name != "face")) continue;
      if (property.name == wanted) return;
      known.push_back(fmt::format("{} ({})", property.name, element.name));
    }
  throw std::invalid_argument(fmt::format("no vertex and no face has a property '{}'; the file has {}",
                                          wanted, fmt::join(known, ", ")));
}

void require(const Header& header, std::string_view element_name, std::string_view property_name) {
  for (const Element& element : header.elements)
    for (const Property& property : element.properties)
      if (element.name == element_name && property.name.starts_with(property_name)) return;
  throw std::invalid_argument(
      fmt::format("element {} with property {} is missing", element_name, property_name));
}

PolygonSoup read_ply(std::string_view bytes, Wanted& wanted) {
  TextLines lines(bytes);
  const Header header = read_header(lines);
  for (const std::string_view axis : {"x", "y", "z"}) require(header, "vertex", axis);
  require(header, "face", "vertex_ind");

  ValueSource next;
  if (header.format == "ascii")
    next = text_source(lines);
  else if (header.format == "binary_little_endian" || header.format == "binary_big_endian")
    next = binary_source(lines.rest(), header.format == "binary_little_endian");
  else
    throw std::invalid_argument(
        fmt::format("format '{}' is not known; allowed are ascii, binary_little_endian, binary_big_endian",
                    header.format));
  PolygonSoup soup;
  PolygonList polygons(soup, "face");
  if (!wanted.property.empty()) require_wanted(header, wanted.property);
  for (const Element& element : header.elements) read_element(element, next, soup, polygons, wanted);
  polygons.cut();
  return soup;
}

}  // namespace

PolygonSoup parse_ply(std::string_view bytes) {
  Wanted nothing;
  return read_ply(bytes, nothing);
}

PlyValues parse_ply_values(std::string_view bytes, std::string_view property) {
  Wanted wanted{.property = property, .of_points = {}, .of_triangles = {}};
  PlyValues values{.soup = read_ply(bytes, wanted), .of_points = {}, .of_triangles = {}};
  if (!wanted.of_points.empty())
    values.of_points = std::move(wanted.of_points);
  else
    values.of_triangles = std::move(wanted.of_triangles);
  return values;
}

}  // namespace bendlab
