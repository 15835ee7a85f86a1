#include "bendlab/solver/elastic_system.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bendlab/constraints/corners.hpp"
#include "bendlab/constraints/oracle.hpp"
#include "bendlab/solver/memory.hpp"

namespace bendlab {
namespace {

template <std::size_t N>
using Corners = std::array<Vector3, N>;
template <std::size_t N>
using Gradient = std::array<Vector3, N>;
using Slopes = std::array<double, 3>;  // of the components of an element

// ψ and its derivatives at C.
struct Potential {
  double value, slope, curvature;
};

Potential quadratic(double c, double alpha) {
  return {0.5 * c * c / alpha, c / alpha, 1 / alpha};
}

// Refers to a function that outlives the reference.
template <class Signature>
class FunctionRef;
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
 public:
  template <class Function>
  FunctionRef(const Function& function)
      : function_(&function), call_([](const void* object, Arguments... arguments) -> Result {
          return (*static_cast<const Function*>(object))(arguments...);
        }) {}
  Result operator()(Arguments... arguments) const { return call_(function_, arguments...); }

 private:
  const void* function_;
  Result (*call_)(const void*, Arguments...);
};

// One energy term. The terms of an element with several components follow each other.
template <std::size_t N>
struct Term {
  Eigen::Index index;
  const std::array<int, N>& vertices;
  FunctionRef<ConstraintValue<double, N>(const Corners<N>&)> evaluate;  // C and ∇C
  FunctionRef<Potential(double)> potential;                             // ψ, ψ' and ψ'' at C
  // The gradient of Σ C_k times slope k, over all components of the element. Null if every ∇C_k is constant.
  const FunctionRef<Gradient<N>(const Corners<N>&, const Slopes&)>* joint_gradient;
  std::size_t directors = 0;  // among the corners
  std::size_t component = 0, components = 1;

  bool is_last() const { return component + 1 == components; }
};

// A generic function of a term with any number of corners. The code that lists terms calls it by reference,
// because the compiler would otherwise make this code anew for every such function.
template <std::size_t... N>
struct FunctionOfTerms : FunctionRef<void(const Term<N>&)>... {
  template <class Function>
  FunctionOfTerms(const Function& function) : FunctionRef<void(const Term<N>&)>(function)... {}
  using FunctionRef<void(const Term<N>&)>::operator()...;
};

// ψ of a one-sided kind. For C < 0: the kind's own energy divided by α. For C > 0: a force that falls to 0.
template <class Kind>
Potential one_sided(double c, const std::array<double, Kind::rest_values>& rest, typename Kind::Law law,
                    double alpha) {
  if (c < 0) {
    const auto own = Kind::potential(c, rest, law);
    return {own.energy / alpha, own.slope / alpha, own.curvature / alpha};
  }
  const double straight = Kind::potential(0, rest, law).slope, width = ElasticSystem::ramp * rest[0];
  const double left = std::max(0.0, 1 - c / width);
  return {0.5 * straight * width * (1 - left * left) / alpha, straight * left / alpha,
          left > 0 ? -straight / width / alpha : 0};
}

// Matrices of an element, 3N by 3N, are plain numbers row by row: the compiler takes seconds for Eigen's
// matrices of each size.
struct ElementMatrix {
  std::size_t width = 0;  // 3N
  std::vector<double> numbers;

  double& at(std::size_t row, std::size_t column) { return numbers[row * width + column]; }

  void reset(std::size_t corners) {
    width = 3 * corners;
    numbers.assign(width * width, 0.0);
  }

  // Adds factor times g gᵀ. `gradient`: 3N numbers.
  void add_square(const double* gradient, double factor) {
    for (std::size_t row = 0; row < width; ++row)
      for (std::size_t column = 0; column < width; ++column)
        at(row, column) += factor * gradient[row] * gradient[column];
  }
};

// Adds the second derivative of C times the slope, if C is the distance of two points minus a constant.
void add_second_of_distance(ElementMatrix& matrix, const Corners<2>& p, double slope) {
  const Vector3 d = p[0] - p[1];
  const Eigen::Matrix3d across =
      (Eigen::Matrix3d::Identity() - d * d.transpose() / d.squaredNorm()) / d.norm();
  for (std::size_t row = 0; row < 6; ++row)
    for (std::size_t column = 0; column < 6; ++column)
      matrix.at(row, column) += ((row < 3) == (column < 3) ? slope : -slope) *
                                across(static_cast<int>(row % 3), static_cast<int>(column % 3));
}

// Adds the second derivative of Σ C_k times slope k, as the central difference of its gradient, made
// symmetric.
template <std::size_t N>
void add_second(ElementMatrix& matrix, Corners<N> p, std::size_t directors, const Slopes& slopes,
                const FunctionRef<Gradient<N>(const Corners<N>&, const Slopes&)>& gradient) {
  double size = 0;  // two corners may lie in one place
  for (std::size_t i = 1; i < N - directors; ++i) size = std::max(size, (p[i] - p[0]).norm());
  const double step = 1e-6 * size;
  for (std::size_t column = 0; column < 3 * N; ++column) {
    double& x = p[column / 3](static_cast<int>(column % 3));
    const double at = x;
    x = at + step;
    const Gradient<N> ahead = gradient(p, slopes);
    x = at - step;
    const Gradient<N> behind = gradient(p, slopes);
    x = at;
    for (std::size_t row = 0; row < 3 * N; ++row) {
      const double change = (ahead[0].data()[row] - behind[0].data()[row]) / (4 * step);
      matrix.at(row, column) += change, matrix.at(column, row) += change;
    }
  }
}

Eigen::MatrixXd without_negative_eigenvalues(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).asDiagonal() *
         solver.eigenvectors().transpose();
}

void require_compliance(StiffnessKind kind, double compliance, const char* what) {
  if (kind != StiffnessKind::compliance || !(compliance > 0))
    throw std::invalid_argument(
        std::string("equilibrium: ") + what +
        " needs its stiffness as a compliance above 0, because a stiffness given as k has no energy");
}

// Visits the term of a constraint that has one term.
template <std::size_t N, class Visit, class Evaluate, class Psi>
void visit_single(const Visit& visit, Eigen::Index index, const std::array<int, N>& vertices,
                  const Evaluate& evaluate, const Psi& potential, std::size_t directors = 0) {
  const auto joint = [&](const Corners<N>& p, const Slopes& slopes) {
    Gradient<N> gradient = evaluate(p).gradient;
    for (Vector3& g : gradient) g *= slopes[0];
    return gradient;
  };
  const FunctionRef<Gradient<N>(const Corners<N>&, const Slopes&)> joint_gradient(joint);
  visit(Term<N>{index, vertices, evaluate, potential, &joint_gradient, directors});
}

}  // namespace

struct ElasticSystem::Visit : FunctionOfTerms<2, 3, 4, 6, 9, 13> {
  using FunctionOfTerms::FunctionOfTerms;
};

ElasticSystem::ElasticSystem(const SimulationInput& input)
    : strain_(input.strain),
      strain_stiffness_(input.strain_stiffness),
      distance_(input.distance),
      elements_(input.elements),
      own_(input.own),
      bending_compliance_(input.bending_stiffness.compliance),
      stated_strain_(input.strain_stiffness.compliance),
      stated_bending_(input.bending_stiffness.compliance) {
  if (strain_.size() > 0) require_compliance(strain_stiffness_.kind, strain_stiffness_.compliance, "strain");
  if (distance_.size() > 0 || element_count(elements_) > 0 || own_.size() > 0)
    require_compliance(input.bending_stiffness.kind, bending_compliance_, "bending");
  for (std::size_t p = 0; p < input.point_count(); ++p)
    free_index_.push_back(input.is_free(p) ? free_count_++ : -1);
  for (std::size_t p = 0; p < input.held.size(); ++p)
    for (int axis = 0; axis < 3; ++axis)
      if (free_index_[p] >= 0 && input.is_held(p, axis)) {
        is_held_.resize(static_cast<std::size_t>(unknowns()), 0);
        is_held_[static_cast<std::size_t>(3 * free_index_[p] + axis)] = 1;
      }
  first_director_ = input.mass.size(), read_coordinates_ = input.directors.coordinates;
  for_terms([&](const auto&) { ++energy_terms_; });
  energy_terms_ += static_cast<Eigen::Index>(own_.size());
  find_pattern();
}

void ElasticSystem::for_terms(const Visit& visit) const {
  Eigen::Index next = 0;
  for (std::size_t t = 0; t < strain_.size(); ++t) strain_terms(t, next, visit);
  for (std::size_t c = 0; c < distance_.size(); ++c) distance_term(c, next, visit);
  for_each_kind(elements_, [&](const auto& list) {
    for (std::size_t c = 0; c < list.size(); ++c) element_terms(list, c, next, visit);
  });
}

void ElasticSystem::strain_terms(std::size_t t, Eigen::Index& next, const Visit& visit) const {
  const StrainStiffness& s = strain_stiffness_;
  const double stretch_scale = stretch_softness(s.form);
  const std::array<double, 4>& q = strain_.inverse_rest[t];
  const double alpha =
      (strain_.softness.empty() ? strain_softness_ : strain_softness_ * strain_.softness[t]) * s.compliance *
      2 * std::abs(q[0] * q[3] - q[1] * q[2]);  // compliance / rest area
  const auto term = [&](double part, double scale, const auto& evaluate) {
    if (part != 0)
      visit_single<3>(visit, next++, strain_.vertices[t], evaluate,
                      [&](double c) { return quadratic(c, scale * alpha); });
  };
  term(s.warp, s.softness[0] * stretch_scale,
       [&](const Corners<3>& p) { return stretch_constraint(p, q, 0, s.form); });
  term(s.weft, s.softness[1] * stretch_scale,
       [&](const Corners<3>& p) { return stretch_constraint(p, q, 1, s.form); });
  term(s.shear, s.softness[2] * shear_softness(s.form),
       [&](const Corners<3>& p) { return shear_constraint(p, q, s.form); });
  if (s.area != 0)
    term(s.area, area_softness(s.form, s.area), [&](const Corners<3>& p) { return area_term(p, q, s.form); });
}

void ElasticSystem::distance_term(std::size_t c, Eigen::Index& next, const Visit& visit) const {
  const double alpha = bending_compliance_ * (distance_.softness.empty() ? 1 : distance_.softness[c]);
  visit_single<2>(
      visit, next++, distance_.vertices[c],
      [&](const Corners<2>& p) { return distance_constraint(p, distance_.rest(c)); },
      [&](double value) { return quadratic(value, alpha); });
}

template <class Kind>
void ElasticSystem::element_terms(const ElementList<Kind>& list, std::size_t c, Eigen::Index& next,
                                  const Visit& visit) const {
  const double alpha = bending_compliance_ * list.softness[c];
  constexpr std::size_t N = Kind::arity, directors = directors_of<Kind>;
  const std::array<double, Kind::rest_values>& rest = list.rest[c];
  if constexpr (HasComponents<Kind>)
    if (is_sum_of_squares<Kind>(rest, list.law)) {
      static_assert(Kind::components == std::tuple_size_v<Slopes>);
      const auto joint = [&](const Corners<N>& p, const Slopes& slopes) {
        if constexpr (Kind::linear_components)
          return Gradient<N>{};
        else
          return Kind::weighted_components(p, rest, list.law, slopes).gradient;
      };
      const FunctionRef<Gradient<N>(const Corners<N>&, const Slopes&)> joint_gradient(joint);
      // If the moment is not linear, its secant stiffness and its energy depend on the whole C, the root of
      // the sum of squares. The whole energy counts at the first component.
      Resistance whole{0, 1};
      for (std::size_t k = 0; k < Kind::components; ++k)
        visit(Term<N>{next++, list.vertices[c],
                      [&](const Corners<N>& p) {
                        if (!list.moment.empty())
                          whole = resistance(list.moment, c,
                                             Kind::template value<double>(p, rest, list.law).value);
                        return Kind::component(p, rest, list.law, k);
                      },
                      [&](double value) {
                        Potential psi = quadratic(value, alpha);
                        if (list.moment.empty()) return psi;
                        psi.slope *= whole.secant, psi.curvature *= whole.secant;
                        psi.value = k == 0 ? whole.energy / alpha : 0;
                        return psi;
                      },
                      Kind::linear_components ? nullptr : &joint_gradient, directors, k, Kind::components});
      return;
    }
  visit_single<N>(
      visit, next++, list.vertices[c],
      [&](const Corners<N>& p) { return Kind::template value<double>(p, rest, list.law); },
      [&](double value) {
        if constexpr (OneSided<Kind>) return one_sided<Kind>(value, rest, list.law, alpha);
        Potential psi = quadratic(value, alpha);
        if (list.moment.empty()) return psi;
        const Resistance now = resistance(list.moment, c, value);
        return Potential{now.energy / alpha, psi.slope * now.secant, psi.curvature * now.secant};
      },
      directors);
}

template <class Visitor>
void ElasticSystem::own_terms(const Positions& positions, const Visitor& visit) const {
  if (own_.size() == 0) return;
  const OwnValues all = evaluate(own_, positions);
  const bool is_energy = own_.function->is_energy();
  const Eigen::Index first = energy_terms_ - static_cast<Eigen::Index>(own_.size());
  for (std::size_t c = 0; c < own_.size(); ++c) {
    const double alpha = bending_compliance_ * own_.softness[c], value = all.values[c];
    if (std::isfinite(value))
      visit(first + static_cast<Eigen::Index>(c), c,
            is_energy ? Potential{value / alpha, 1 / alpha, 0} : quadratic(value, alpha),
            &all.gradients[3 * own_.arity * c]);
  }
}

ElasticSystem::AtVertex ElasticSystem::at_vertex(const Positions& positions, int vertex) {
  if (constraints_at_.empty()) find_constraints_at_vertices();
  AtVertex sum{0, Vector3::Zero(), Eigen::Matrix3d::Zero()};
  const auto add = [&](const auto& term) {
    const auto c = term.evaluate(corners(positions, term.vertices));
    if (!c.defined) return;
    Vector3 gradient = Vector3::Zero();  // an element may name a vertex twice
    for (std::size_t i = 0; i < term.vertices.size(); ++i)
      if (term.vertices[i] == vertex) gradient += c.gradient[i];
    const Potential psi = term.potential(c.value);
    sum.energy += psi.value;
    sum.force -= psi.slope * gradient;
    sum.stiffness += std::max(0.0, psi.curvature) * gradient * gradient.transpose();
  };
  const Visit visit(add);
  for (const Listed& at : constraints_at_[static_cast<std::size_t>(vertex)]) {
    Eigen::Index term = 0;
    if (at.list == 0) strain_terms(at.index, term, visit);
    if (at.list == 1) distance_term(at.index, term, visit);
    for_each_kind(elements_, [&]<class Kind>(const ElementList<Kind>& elements) {
      if (at.list == 2 + kind_index<Kind>) element_terms(elements, at.index, term, visit);
    });
  }
  return sum;
}

void ElasticSystem::find_constraints_at_vertices() {
  constraints_at_.resize(free_index_.size());
  const auto add = [&](std::size_t list, const auto& constraints) {
    for (std::size_t c = 0; c < constraints.size(); ++c)
      for (const int v : constraints.vertices[c])
        if (auto& at = constraints_at_[static_cast<std::size_t>(v)];
            at.empty() || at.back().list != list || at.back().index != c)
          at.push_back({list, c});
  };
  add(0, strain_), add(1, distance_);
  for_each_kind(elements_,
                [&]<class Kind>(const ElementList<Kind>& list) { add(2 + kind_index<Kind>, list); });
}

std::size_t ElasticSystem::term_count() const {
  return strain_.size() + distance_.size() + element_count(elements_) + own_.size();
}

std::size_t ElasticSystem::memory_bytes() const {
  std::size_t sum = bytes_of(strain_.vertices) + bytes_of(strain_.inverse_rest) +
                    bytes_of(distance_.vertices) + bytes_of(distance_.rest_length) +
                    bytes_of(distance_.softness) + bytes_of(free_index_) + bytes_of(blocks_) +
                    bytes_of(hessian_) + bytes_of(own_.vertices) + bytes_of(own_.softness);
  for_each_kind(elements_, [&](const auto& list) {
    sum += bytes_of(list.vertices) + bytes_of(list.rest) + bytes_of(list.softness);
  });
  return sum;
}

double ElasticSystem::energy(const Positions& positions) const {
  double sum = 0;
  for_terms([&](const auto& term) {
    const auto c = term.evaluate(corners(positions, term.vertices));
    if (c.defined) sum += term.potential(c.value).value;
  });
  own_terms(positions,
            [&](Eigen::Index, std::size_t, const Potential& psi, const double*) { sum += psi.value; });
  return sum;
}

Eigen::VectorXd ElasticSystem::gradient(const Positions& positions) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(unknowns());
  for_terms([&](const auto& term) {
    const auto c = term.evaluate(corners(positions, term.vertices));
    if (!c.defined) return;
    const double slope = term.potential(c.value).slope;
    for (std::size_t i = 0; i < term.vertices.size(); ++i)
      if (const int at = free_index_[static_cast<std::size_t>(term.vertices[i])]; at >= 0)
        sum.segment<3>(3 * at) += slope * c.gradient[i];
  });
  own_terms(positions, [&](Eigen::Index, std::size_t c, const Potential& psi, const double* gradient) {
    for (const int v : own_.corners(c)) {
      if (const int at = free_index_[static_cast<std::size_t>(v)]; at >= 0)
        sum.segment<3>(3 * at) += psi.slope * Eigen::Map<const Vector3>(gradient);
      gradient += 3;
    }
  });
  drop_held(sum);
  return sum;
}

void ElasticSystem::drop_held(Eigen::VectorXd& of_unknowns) const {
  for (std::size_t u = 0; u < is_held_.size(); ++u)
    if (is_held_[u] != 0) of_unknowns(static_cast<Eigen::Index>(u)) = 0;
}

// A step then leaves held coordinates as they are, because their residual is 0.
void ElasticSystem::uncouple_held() {
  if (is_held_.empty()) return;
  for (int column = 0; column < unknowns(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(hessian_, column); entry; ++entry)
      if (entry.row() != column && (is_held_[static_cast<std::size_t>(entry.row())] != 0 ||
                                    is_held_[static_cast<std::size_t>(column)] != 0))
        entry.valueRef() = 0;
}

Points<double> ElasticSystem::forces(const Positions& positions) const {
  const Eigen::VectorXd all = gradient(positions);
  Points<double> forces(free_index_.size());
  for (std::size_t v = 0; v < forces.size(); ++v)
    if (const int at = free_index_[v]; at >= 0) forces[v].set(-all.segment<3>(3 * at));
  return forces;
}

Eigen::VectorXd ElasticSystem::multipliers(const Positions& positions) const {
  return predicted_multipliers(positions, {});
}

Eigen::VectorXd ElasticSystem::predicted_multipliers(const Positions& positions,
                                                     const Eigen::VectorXd& step) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(energy_terms_);
  for_terms([&](const auto& term) {
    const auto c = term.evaluate(corners(positions, term.vertices));
    if (!c.defined) return;
    const Potential psi = term.potential(c.value);
    result(term.index) = psi.slope;
    if (step.size() > 0) result(term.index) += psi.curvature * change_of(c, term.vertices, step);
  });
  own_terms(positions, [&](Eigen::Index term, std::size_t c, const Potential& psi, const double* gradient) {
    double change = 0;
    for (const int v : own_.corners(c)) {
      if (const int at = free_index_[static_cast<std::size_t>(v)]; at >= 0 && step.size() > 0)
        change += Eigen::Map<const Vector3>(gradient).dot(step.segment<3>(3 * at));
      gradient += 3;
    }
    result(term) = psi.slope + psi.curvature * change;
  });
  return result;
}

double ElasticSystem::strain_beyond_first_order(const Positions& positions,
                                                const Eigen::VectorXd& step) const {
  const Positions there = moved(positions, step);
  double largest = 0;
  for_terms([&]<std::size_t N>(const Term<N>& term) {
    if constexpr (N == 3) {
      const auto before = term.evaluate(corners(positions, term.vertices)),
                 after = term.evaluate(corners(there, term.vertices));
      if (before.defined && after.defined)
        largest =
            std::max(largest, std::abs(after.value - before.value - change_of(before, term.vertices, step)));
    }
  });
  return largest;
}

Eigen::VectorXd ElasticSystem::convex(Eigen::VectorXd multipliers) const {
  const StrainStiffness& s = strain_stiffness_;
  Eigen::Index term = 0;
  for (std::size_t t = 0; t < strain_.size(); ++t) {
    for (const double k : {s.warp, s.weft})
      if (k != 0) multipliers(term) = std::max(0.0, multipliers(term)), ++term;
    for (const double k : {s.shear, s.area})
      if (k != 0) multipliers(term++) = 0;
  }
  for (std::size_t c = 0; c < distance_.size(); ++c, ++term)
    multipliers(term) = std::max(0.0, multipliers(term));
  multipliers.tail(energy_terms_ - term).setZero();
  return multipliers;
}

template <class Value, std::size_t N>
double ElasticSystem::change_of(const Value& c, const std::array<int, N>& vertices,
                                const Eigen::VectorXd& step) const {
  double change = 0;
  for (std::size_t i = 0; i < N; ++i)
    if (const int at = free_index_[static_cast<std::size_t>(vertices[i])]; at >= 0)
      change += c.gradient[i].dot(step.segment<3>(3 * at));
  return change;
}

Positions ElasticSystem::moved(const Positions& positions, const Eigen::VectorXd& step) const {
  Positions result = positions;
  for (std::size_t v = 0; v < free_index_.size(); ++v)
    if (const int at = free_index_[v]; at >= 0)
      result.row(static_cast<Eigen::Index>(v)) += step.segment<3>(3 * at).transpose();
  return result;
}

const Eigen::SparseMatrix<double>& ElasticSystem::hessian(const Positions& positions,
                                                          const Eigen::VectorXd& multipliers) {
  std::fill_n(hessian_.valuePtr(), hessian_.nonZeros(), 0.0);
  ElementMatrix matrix;
  Slopes slopes{};
  for_terms([&]<std::size_t N>(const Term<N>& term) {
    const Corners<N> p = corners(positions, term.vertices);
    const auto c = term.evaluate(p);
    if (!c.defined) return;
    if (term.component == 0) matrix.reset(N), slopes = {};
    slopes[term.component] = multipliers(term.index);
    const double curvature = term.potential(c.value).curvature;
    if (curvature != 0) matrix.add_square(c.gradient[0].data(), curvature);
    if (!term.is_last()) return;
    if (term.joint_gradient != nullptr && slopes != Slopes{}) {
      if constexpr (N == 2)
        add_second_of_distance(matrix, p, slopes[0]);
      else
        add_second<N>(matrix, p, term.directors, slopes, *term.joint_gradient);
    }
    add_blocks(term.vertices, matrix.numbers.data());
  });
  add_own_hessian(positions, multipliers);
  hold_unread_coordinates();
  uncouple_held();
  return hessian_;
}

// Coordinates of directors that the model does not read get the stiffness of the coordinate that it reads, so
// that the matrix is definite.
void ElasticSystem::hold_unread_coordinates() {
  for (std::size_t p = first_director_; p < free_index_.size(); ++p) {
    if (free_index_[p] < 0) continue;
    const auto diagonal = [&](int k) -> double& {  // the first entry of a column is its diagonal
      return hessian_.valuePtr()[hessian_.outerIndexPtr()[3 * free_index_[p] + k]];
    };
    if (diagonal(0) == 0) diagonal(0) = 1;
    for (int k = read_coordinates_; k < 3; ++k) diagonal(k) = diagonal(0);
  }
}

void ElasticSystem::add_own_hessian(const Positions& positions, const Eigen::VectorXd& multipliers) {
  if (own_.size() == 0) return;
  const auto count = static_cast<Eigen::Index>(own_.size());
  const bool is_energy = own_.function->is_energy();
  std::vector<Eigen::MatrixXd> second;
  if (is_energy || multipliers.tail(count).any()) second = second_derivatives(own_, positions);
  own_terms(positions, [&](Eigen::Index term, std::size_t c, const Potential& psi, const double* first) {
    const auto width = static_cast<Eigen::Index>(3 * own_.arity);
    const Eigen::Map<const Eigen::VectorXd> gradient(first, width);
    Eigen::MatrixXd whole = psi.curvature * gradient * gradient.transpose();
    if (is_energy && multipliers(term) == 0)
      whole += psi.slope * without_negative_eigenvalues(second[c]);
    else if (multipliers(term) != 0)
      whole += multipliers(term) * second[c];
    add_blocks(own_.corners(c), whole.data());  // a symmetric matrix, by columns or by rows
  });
}

// Adds the matrix of an element, row by row. The first block of a column is on the diagonal, so only the
// lower triangle of this block is stored.
void ElasticSystem::add_blocks(std::span<const int> vertices, const double* matrix) {
  const std::size_t width = 3 * vertices.size();
  for (std::size_t j = 0; j < vertices.size(); ++j) {
    const int column = free_index_[static_cast<std::size_t>(vertices[j])];
    if (column < 0) continue;
    const std::vector<int>& rows = blocks_[static_cast<std::size_t>(column)];
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const int row = free_index_[static_cast<std::size_t>(vertices[i])];
      if (row < column) continue;
      const auto rank = std::lower_bound(rows.begin(), rows.end(), row) - rows.begin();
      for (std::size_t c = 0; c < 3; ++c) {
        double* const values =
            hessian_.valuePtr() + hessian_.outerIndexPtr()[3 * column + static_cast<int>(c)] + 3 * rank;
        for (std::size_t r = rank == 0 ? c : 0; r < 3; ++r)
          values[static_cast<std::ptrdiff_t>(r) - static_cast<std::ptrdiff_t>(c)] +=
              matrix[(3 * i + r) * width + 3 * j + c];
      }
    }
  }
}

void ElasticSystem::find_pattern() {
  blocks_.assign(static_cast<std::size_t>(free_count_), {});
  for (std::size_t v = 0; v < blocks_.size(); ++v) blocks_[v].push_back(static_cast<int>(v));
  const auto couple = [&](const auto& vertices) {
    for (const int a : vertices)
      for (const int b : vertices) {
        const int row = free_index_[static_cast<std::size_t>(a)],
                  column = free_index_[static_cast<std::size_t>(b)];
        if (column >= 0 && row > column) blocks_[static_cast<std::size_t>(column)].push_back(row);
      }
  };
  const auto add = [&](const auto& list) {
    for (const auto& vertices : list.vertices) couple(vertices);
  };
  add(strain_), add(distance_);
  for_each_kind(elements_, add);
  for (std::size_t c = 0; c < own_.size(); ++c) couple(own_.corners(c));
  Eigen::Index count = 0;
  for (std::vector<int>& rows : blocks_) {
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    count += 9 * static_cast<Eigen::Index>(rows.size()) - 3;
  }
  hessian_.resize(unknowns(), unknowns());
  hessian_.reserve(count);
  for (int column = 0; column < unknowns(); ++column) {
    hessian_.startVec(column);
    for (const int row : blocks_[static_cast<std::size_t>(column / 3)])
      for (int r = std::max(column, 3 * row); r < 3 * row + 3; ++r) hessian_.insertBack(r, column) = 0;
  }
  hessian_.finalize();
}

}  // namespace bendlab
