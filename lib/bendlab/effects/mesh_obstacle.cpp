// Mesh obstacle: a triangle mesh from a file, closed (the cloth stays outside) or open (the cloth stays on
// its side).
//
// * A vertex is pushed away from the nearest point of the mesh. The search for this point is repeated only
//   after the vertex has moved by its distance from the mesh. So a distant vertex costs one comparison.
// * If a vertex moves far in a substep, compared with the thickness, and meets the mesh, it is moved outside
//   the plane of the first triangle on its path.
// * Edges of the cloth are tested against ridges of the mesh, and triangles of the cloth against pointed
//   corners of the mesh. The pairs to test are found once per substep, on the predicted positions.
//
// Limit: edges and triangles are tested only at the end of a substep. If an edge moves by more than the
// thickness and half its length, it may cut a corner of the mesh between its vertices.
#include <Eigen/Geometry>
#include <algorithm>
#include <memory>
#include <optional>

#include "bendlab/effects/obstacle.hpp"
#include "bendlab/mesh/files.hpp"
#include "bendlab/mesh/half_edges.hpp"
#include "bendlab/mesh/mesh_surface.hpp"

namespace bendlab {
namespace mesh_obstacle_effect {

constexpr std::array own_fields = {
    field<&MeshObstacle::file>({.name = "file",
                                .meaning = "mesh file (.obj, .ply, .off, .stl), relative to the config; if "
                                           "the content of the file changes, the run gets another id",
                                .required = true,
                                .names_file = true}),
    field<&MeshObstacle::scale>({.name = "scale",
                                 .unit = "1",
                                 .meaning = "factor on the file's coordinates",
                                 .minimum = 0,
                                 .above = true}),
    field<&MeshObstacle::offset>({.name = "offset",
                                  .unit = "m",
                                  .meaning = "translation of the mesh, added to the scaled coordinates"}),
};

constexpr auto fields = joined(own_fields, obstacle::body_fields<MeshObstacle>);

TriangleMesh placed(TriangleMesh mesh, const MeshObstacle& settings) {
  mesh.positions *= settings.scale;
  mesh.positions.rowwise() += settings.offset.transpose();
  return mesh;
}

TriangleMesh read_obstacle(const MeshObstacle& settings, const std::filesystem::path& folder) {
  return placed(read_mesh(folder / settings.file), settings);
}

SteadyMotion motion(const MeshObstacle& settings) {
  return {.velocity = settings.velocity};
}

TriangleMesh surface(const MeshObstacle& settings, const SurfaceInput& input) {
  if (input.file == nullptr) return read_obstacle(settings, input.folder);
  return placed(accept(parse_polygon_soup(settings.file, *input.file), BadTriangles::refuse).mesh, settings);
}

// The parameters in (0, 1) of the nearest points of two segments. Empty if one of these points is an end.
std::optional<std::array<double, 2>> nearest_between(const Vector3& a, const Vector3& along, const Vector3& b,
                                                     const Vector3& other) {
  const Vector3 apart = a - b;
  const double aa = along.squaredNorm(), ab = along.dot(other), bb = other.squaredNorm();
  const double determinant = aa * bb - ab * ab;
  if (!(determinant > 1e-12 * aa * bb)) return std::nullopt;  // parallel within 1e-6: vertices are pushed
  const double s = (ab * other.dot(apart) - bb * along.dot(apart)) / determinant;
  const double u = (aa * other.dot(apart) - ab * along.dot(apart)) / determinant;
  if (!(s > 0 && s < 1 && u > 0 && u < 1)) return std::nullopt;
  return std::array{s, u};
}

// The data of an obstacle's two passes. Coordinates are relative to the mesh, so that the mesh does not move.
template <class Real>
class SurfaceContacts {
 public:
  SurfaceContacts(const MeshObstacle& settings, const EffectInput& input)
      : surface_(std::make_shared<const MeshSurface>(read_obstacle(settings, input.folder))),
        motion_(motion(settings)),
        thickness_(settings.thickness),
        longest_(obstacle::longest_edge(input.rest)),
        contacts_used_(input.contacts_used),
        last_searches_(static_cast<std::size_t>(input.rest.vertex_count())) {
    const Positions& corners = surface_->mesh().positions;
    box_ = {corners.colwise().minCoeff().transpose(), corners.colwise().maxCoeff().transpose()};
    for (const auto& t : input.rest.triangles().rowwise())
      triangles_.push_back({input.permuted(t(0)), input.permuted(t(1)), input.permuted(t(2))});
    own_edges();
  }

  // Runs once per substep, on the predicted positions.
  void find_near(PassContext<Real>& context) {
    const obstacle::Step<Real> step(motion_, context);
    corners_near_.clear(), ridges_near_.clear();
    if (!any_in_reach(context.state, step)) return;
    for (std::size_t t = 0; t < triangles_.size(); ++t) find_near_triangle(context.state, step, t);
  }

  void push_out(PassContext<Real>& context) {
    const obstacle::Step<Real> step(motion_, context);
    for (const NearRidge& near : ridges_near_) push_edge(context, step, near);
    for (const NearCorner& near : corners_near_) push_triangle(context, step, near);
    for (std::size_t v = 0; v < last_searches_.size(); ++v) push_vertex(context, step, v);
  }

  void archive(Archive& state) { state(last_searches_); }

 private:
  using Vector = Vector3Of<Real>;
  using Step = obstacle::Step<Real>;

  // A vertex's last search for the nearest point of the mesh.
  struct LastSearch {
    Vector3 at = Vector3::Zero();
    double distance = 0;  // m, a lower bound of the distance from `at` to the surface

    void archive(Archive& state) { state(at, distance); }

    bool surely_beyond(double reach, const Vector3& x) const {
      const double left = distance - reach;
      return left > 0 && (x - at).squaredNorm() < left * left;
    }
  };
  struct NearCorner {
    std::size_t triangle;
    int corner;
  };
  struct NearRidge {
    std::array<std::size_t, 2> edge;
    int ridge;
  };
  struct Push {
    Vector3 normal;
    double depth;
  };

  // Every edge belongs to the first of its triangles.
  void own_edges() {
    owned_.assign(3 * triangles_.size(), 0);
    const auto vertex = [&](std::size_t t, std::size_t corner) { return triangles_[t][corner]; };
    for_each_edge(half_edges(triangles_.size(), vertex),
                  [&](std::span<const HalfEdge<std::size_t>> sides) { owned_[sides[0].side] = 1; });
  }

  static Vector3 now(const State<Real>& state, const Step& step, std::size_t v) {
    return state.position[v].vector().template cast<double>() - step.shift();
  }
  static Vector3 before(const State<Real>& state, const Step& step, std::size_t v) {
    return Vector(state.previous[v].vector() + step.advance()).template cast<double>() - step.shift();
  }

  double distance_to_box(const Vector3& x) const { return box_.exteriorDistance(x); }

  // Tests only vertices, because no point of a triangle is farther from a corner than the longest side.
  bool any_in_reach(const State<Real>& state, const Step& step) const {
    double way = 0;
    for (std::size_t v = 0; v < last_searches_.size(); ++v)
      way = std::max(way, (now(state, step, v) - before(state, step, v)).squaredNorm());
    const double reach = thickness_ + std::sqrt(way) + longest_;
    for (std::size_t v = 0; v < last_searches_.size(); ++v)
      if (!last_searches_[v].surely_beyond(reach, now(state, step, v))) return true;
    return false;
  }

  void find_near_triangle(const State<Real>& state, const Step& step, std::size_t t) {
    const std::array<std::size_t, 3>& vertices = triangles_[t];
    std::array<Vector3, 3> x;
    double reach = thickness_, side = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = now(state, step, vertices[i]);
      reach = std::max(reach, thickness_ + (x[i] - before(state, step, vertices[i])).norm());
      side = std::max(side, (x[i] - x[0]).norm());
    }
    if (last_searches_[vertices[0]].surely_beyond(reach + side, x[0])) return;
    const auto [low, high] = bounds(x, reach);
    if ((low.array() > box_.max().array()).any() || (high.array() < box_.min().array()).any()) return;
    faces_.clear();
    surface_->triangles_in_box(low, high, faces_);
    add_features(t, x, reach);
  }

  template <std::size_t count>
  static std::pair<Vector3, Vector3> bounds(const std::array<Vector3, count>& x, double reach) {
    Vector3 low = x[0], high = x[0];
    for (const Vector3& corner : x) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
    return {low.array() - reach, high.array() + reach};
  }

  void add_features(std::size_t t, const std::array<Vector3, 3>& x, double reach) {
    corners_.clear(), ridges_.clear();
    for (const int face : faces_)
      for (int i = 0; i < 3; ++i) {
        if (const int ridge = surface_->ridges_of(face)[static_cast<std::size_t>(i)]; ridge >= 0)
          ridges_.push_back(ridge);
        if (const int corner = surface_->mesh().triangles(face, i); surface_->is_pointed(corner))
          corners_.push_back(corner);
      }
    for (std::vector<int>* list : {&corners_, &ridges_}) {
      std::ranges::sort(*list);
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    const auto [low, high] = bounds(x, reach);
    for (const int corner : corners_)
      if (const Vector3 c = surface_->corner(corner);
          (c.array() >= low.array()).all() && (c.array() <= high.array()).all())
        corners_near_.push_back({t, corner});
    for (std::size_t i = 0; i < 3; ++i)
      if (owned_[3 * t + i])
        add_ridges({triangles_[t][i], triangles_[t][(i + 1) % 3]}, {x[i], x[(i + 1) % 3]}, reach);
  }

  void add_ridges(const std::array<std::size_t, 2>& edge, const std::array<Vector3, 2>& x, double reach) {
    const auto [low, high] = bounds(x, reach);
    for (const int ridge : ridges_) {
      const std::array<int, 2>& ends = surface_->ridges()[static_cast<std::size_t>(ridge)].corners;
      const auto [from, to] = bounds(std::array{surface_->corner(ends[0]), surface_->corner(ends[1])}, 0);
      if ((from.array() <= high.array()).all() && (to.array() >= low.array()).all())
        ridges_near_.push_back({edge, ridge});
    }
  }

  // How to push a point x of the cloth out; empty if x is far enough away. `offset` is the vector from the
  // nearest ridge or corner of the mesh to x, and `normal` is the mean normal there.
  std::optional<Push> way_out(const Vector3& x, const Vector3& from, const Vector3& offset,
                              const Vector3& normal) const {
    const double distance = offset.norm();
    if (!surface_->closed()) {
      if (const auto crossed = surface_->first_crossing(from, x))
        return Push{crossed->normal, thickness_ - crossed->normal.dot(x - crossed->point)};
    } else if (offset.dot(normal) < 0) {
      if (const MeshSurface::Nearest nearest = surface_->nearest(x); nearest.inside)
        return Push{(nearest.point - x) / nearest.distance, thickness_ + nearest.distance};
    }
    if (distance >= thickness_) return std::nullopt;
    return Push{distance > 0 ? Vector3(offset / distance) : normal, thickness_ - distance};
  }

  void push_edge(PassContext<Real>& context, const Step& step, const NearRidge& near) const {
    const MeshSurface::Ridge& ridge = surface_->ridges()[static_cast<std::size_t>(near.ridge)];
    const State<Real>& state = context.state;
    const Vector3 a = now(state, step, near.edge[0]), along = now(state, step, near.edge[1]) - a;
    const Vector3 b = surface_->corner(ridge.corners[0]), other = surface_->corner(ridge.corners[1]) - b;
    const auto nearest = nearest_between(a, along, b, other);
    if (!nearest) return;
    const auto [s, u] = *nearest;
    const Vector3 x = a + s * along;
    const Vector3 from = (1 - s) * before(state, step, near.edge[0]) + s * before(state, step, near.edge[1]);
    if (const auto out = way_out(x, from, x - b - u * other, ridge.normal); out && out->depth > 0)
      obstacle::push_together<Real, 2>(
          context, step, near.edge, {static_cast<Real>(1 - s), static_cast<Real>(s)},
          out->normal.template cast<Real>(), static_cast<Real>(out->depth), contacts_used_);
  }

  void push_triangle(PassContext<Real>& context, const Step& step, const NearCorner& near) const {
    const std::array<std::size_t, 3>& vertices = triangles_[near.triangle];
    const State<Real>& state = context.state;
    const Vector3 corner = surface_->corner(near.corner);
    const std::array<Vector3, 3> x = {now(state, step, vertices[0]), now(state, step, vertices[1]),
                                      now(state, step, vertices[2])};
    const Vector3 w = nearest_weights(corner, x[0], x[1], x[2]);
    if (!(w.minCoeff() > 0)) return;  // on an edge: ridges and vertices are pushed
    const Vector3 at = w(0) * x[0] + w(1) * x[1] + w(2) * x[2];
    const Vector3 from = w(0) * before(state, step, vertices[0]) + w(1) * before(state, step, vertices[1]) +
                         w(2) * before(state, step, vertices[2]);
    if (const auto out = way_out(at, from, at - corner, surface_->corner_normal(near.corner));
        out && out->depth > 0)
      obstacle::push_together<Real, 3>(
          context, step, vertices,
          {static_cast<Real>(w(0)), static_cast<Real>(w(1)), static_cast<Real>(w(2))},
          out->normal.template cast<Real>(), static_cast<Real>(out->depth), contacts_used_);
  }

  void push_vertex(PassContext<Real>& context, const Step& step, std::size_t v) {
    if (!(context.state.position[v].w > 0)) return;
    const Vector3 x = now(context.state, step, v), from = before(context.state, step, v);
    LastSearch& last = last_searches_[v];
    if (last.surely_beyond(thickness_, x) && last.surely_beyond(0, from)) return;
    if (const double far = distance_to_box(x); far > thickness_ + (x - from).norm()) {
      last = {x, far};
      return;
    }
    const MeshSurface::Nearest nearest = surface_->nearest(x);
    last = {x, nearest.inside ? 0 : nearest.distance};
    const std::optional<Push> out = crossed(x, from, nearest);
    if (out && out->depth > 0)
      obstacle::push(context, step, v, Vector(out->normal.template cast<Real>()),
                     static_cast<Real>(out->depth), contacts_used_);
  }

  std::optional<Push> crossed(const Vector3& x, const Vector3& from,
                              const MeshSurface::Nearest& nearest) const {
    const double way = (x - from).norm();
    if (way > thickness_ / 2 && nearest.distance < way + thickness_)
      if (const auto crossing = surface_->first_crossing(from, x);
          crossing && (crossing->from_front || !surface_->closed()))
        return Push{crossing->normal, thickness_ - crossing->normal.dot(x - crossing->point)};
    if (!nearest.inside && nearest.distance >= thickness_) return std::nullopt;
    const double height = nearest.inside ? -nearest.distance : nearest.distance;
    const Vector3 normal = nearest.distance > 0 ? Vector3((x - nearest.point) / height) : nearest.normal;
    return Push{normal, thickness_ - height};
  }

  std::shared_ptr<const MeshSurface> surface_;
  SteadyMotion motion_;
  double thickness_, longest_;  // m; longest_: longest edge of the cloth
  bool contacts_used_;
  Eigen::AlignedBox3d box_;
  std::vector<LastSearch> last_searches_;  // #V
  std::vector<std::array<std::size_t, 3>> triangles_;
  std::vector<char> owned_;  // 3 #T
  std::vector<NearCorner> corners_near_;
  std::vector<NearRidge> ridges_near_;
  std::vector<int> faces_, corners_, ridges_;  // for the current triangle
};

template <class Real>
std::vector<Pass<Real>> compile(const MeshObstacle& settings, const EffectInput& input) {
  const auto obstacle = std::make_shared<SurfaceContacts<Real>>(settings, input);
  return {{"mesh_obstacle", Stage::predicted, [obstacle](PassContext<Real>& c) { obstacle->find_near(c); }},
          {"mesh_obstacle", Stage::project, [obstacle](PassContext<Real>& c) { obstacle->push_out(c); },
           [obstacle](Archive& state) { obstacle->archive(state); }}};
}

}  // namespace mesh_obstacle_effect

constinit const EffectKind MeshObstacle::kind{
    .name = "mesh_obstacle",
    .summary = "an obstacle: a triangle mesh from a file, closed or open",
    .source = "nearest points by CGAL's AABB tree; inside or outside by Bærentzen & Aanæs 2005",
    .settings = table_of<MeshObstacle>(mesh_obstacle_effect::fields),
    .needs_projection = true,
    .acts_in_iterations = true,
    .repeatable = true,
    .compile_float = erased<mesh_obstacle_effect::compile<float>>,
    .compile_double = erased<mesh_obstacle_effect::compile<double>>,
    .motion = erased<mesh_obstacle_effect::motion>,
    .surface = erased<mesh_obstacle_effect::surface>,
};
}  // namespace bendlab
