#include "run/tangent_map.hpp"

#include <algorithm>
#include <cmath>

#include "integrate/output_state.hpp"
#include "interruption.hpp"
#include "linear/norm.hpp"
#include "linear/product.hpp"
#include "run/run_stepper.hpp"
#include "run/tangent_space.hpp"
#include "scalar/log2_of.hpp"
#include "scene/set_number.hpp"

namespace hbvm::core {
namespace {

/// A state and its neighbours, stepped side by side.
class TangentCourse {
 public:
  TangentCourse(const RunRequest& request, const TangentDigits& digits)
      : request_(request),
        scene_(assemble<Mpfr>(request.scene)),
        problem_(scene_.problem),
        grid_(request.step, request.until, request.scene.constants, Direction::forward, LastStep::shortened),
        point_(problem_),
        epsilon_(pow(Mpfr(10), -(digits.asked + 8))),
        m_(problem_.m()) {
    if (!problem_.is_conservative()) throw InputError("the tangent map is for forces with a potential, without t");
    constexpr long fewest = 10;
    if (grid_.steps() < fewest) throw InputError("the tangent map takes ten steps or more");
    // One k for all: that which the start asks for.
    method_ = RunStepper<Mpfr>(scene_, request.method, grid_.step(), request.solver, OnFailure::stop).method();
    main_ = stepper();
    now_ = {scene_.q0, point_.tangential(scene_.q0, scene_.p0)};
    space_.emplace(problem_, now_);
    basis_ = space_->basis(now_, epsilon_);
    for (Index i = 0; i < basis_.cols(); ++i) neighbours_.push_back(stepper());
  }

  TangentMap follow(const std::function<void(double)>& progress) {
    TangentMap map;
    map.start = space_->unscaled(basis_);
    const Mpfr form = form_size(map.start);
    const Matrix<Mpfr> forms = forms_of(map.start);
    const Index n = basis_.cols();
    Matrix<Mpfr> total = Matrix<Mpfr>::Identity(n, n);
    std::vector<std::vector<double>> logs;
    std::vector<double> sums;
    long made = 0;
    while (made < grid_.steps()) {
      const long steps = std::min(block(), grid_.steps() - made);
      const Matrix<Mpfr> changes = advance(made, steps);
      made += steps;
      Matrix<Mpfr> upper;
      basis_ = orthonormal(changes, upper);
      total = Matrix<Mpfr>(upper * total);
      std::vector<double> grown;
      for (Index i = 0; i < n; ++i) grown.push_back(log2_of(upper(i, i)) * std::log(double{2}));
      map.times.push_back(approximately(grid_.time(made)));
      std::vector<double>& means = map.means.emplace_back();
      for (std::size_t i = 0; i < grown.size(); ++i) {
        if (logs.empty()) sums.push_back(0);
        sums[i] += grown[i];
        means.push_back(sums[i] / map.times.back());
      }
      logs.push_back(std::move(grown));
      Mpfr greatest = 0;
      for (Index j = 0; j < n; ++j) raise_to(greatest, norm(Vector<Mpfr>(total.col(j))));
      map.growth.push_back(log10_of(greatest));
      if (progress) progress(static_cast<double>(made) / static_cast<double>(grid_.steps()));
    }
    map.q = now_.q;
    map.p = now_.p;
    map.end = space_->unscaled(Matrix<Mpfr>(basis_ * total));
    map.exponents = exponents_of(map.times, logs);
    map.symplectic_defect = 0;
    const Matrix<Mpfr> end_forms = forms_of(map.end);
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j) raise_magnitude(map.symplectic_defect, Mpfr(end_forms(i, j) - forms(i, j)));
    // Of vectors that have grown, the form is a small difference of great products.
    const Mpfr end_form = form_size(map.end);
    map.symplectic_defect /= end_form > form ? end_form : form;
    map.distance = std::max(log10_of(max_norm(Vector<Mpfr>(now_.q - scene_.q0))) - log10_of(space_->q_scale()),
                            log10_of(max_norm(Vector<Mpfr>(now_.p - scene_.p0))) - log10_of(space_->p_scale()));
    return map;
  }

  /// With the k that the start asks for.
  const MethodPtr& method() const { return method_; }

  PhaseState end() {
    for (long n = 0; n < grid_.steps();) {
      State<Mpfr> state(now_.q, now_.p);
      for (const long last = std::min(n + block(), grid_.steps()); n < last; ++n) step(*main_, state, n);
      now_ = {state.q, point_.tangential(state.q, state.p)};
    }
    return now_;
  }

 private:
  std::unique_ptr<Stepper<Mpfr>> stepper() const { return method_->make_stepper<Mpfr>(problem_, request_.solver); }
  /// Steps between which neighbours stay the same, and after which the output state is gone on from.
  long block() const { return std::clamp<long>(grid_.steps() / 10, 1, 32); }

  /// A run answers Ctrl-C after each of its steps.
  void step(Stepper<Mpfr>& stepper, State<Mpfr>& state, long n) const {
    stepper.step(state, n + 1 == grid_.steps() ? grid_.last_step() : grid_.step());
    end_if_asked("following changes was interrupted");
  }

  /// Makes steps of the state and of neighbours in the directions of the basis. \return what these have become
  Matrix<Mpfr> advance(long first, long steps) {
    std::vector<State<Mpfr>> states;
    for (Index i = 0; i < basis_.cols(); ++i) {
      const PhaseState start = space_->moved(now_, epsilon_ * basis_.col(i));
      states.emplace_back(start.q, start.p);
    }
    State<Mpfr> state(now_.q, now_.p);
    for (long n = first; n < first + steps; ++n) {
      step(*main_, state, n);
      for (std::size_t i = 0; i < states.size(); ++i) step(*neighbours_[i], states[i], n);
    }
    now_ = {state.q, point_.tangential(state.q, state.p)};
    Matrix<Mpfr> changes(2 * m_, basis_.cols());
    for (std::size_t i = 0; i < states.size(); ++i)
      changes.col(static_cast<Index>(i)) =
          space_->change({states[i].q, point_.tangential(states[i].q, states[i].p)}, now_, epsilon_);
    return changes;
  }

  /// Gram and Schmidt's, twice. \param upper triangular: changes = result * upper
  static Matrix<Mpfr> orthonormal(const Matrix<Mpfr>& changes, Matrix<Mpfr>& upper) {
    const Index n = changes.cols();
    Matrix<Mpfr> result = changes;
    upper = Matrix<Mpfr>::Zero(n, n);
    for (Index j = 0; j < n; ++j) {
      Vector<Mpfr> left = changes.col(j);
      for (int twice = 0; twice < 2; ++twice)
        for (Index i = 0; i < j; ++i) {
          const Mpfr part = dot(Vector<Mpfr>(result.col(i)), left);
          upper(i, j) += part;
          left -= part * result.col(i);
        }
      upper(j, j) = norm(left);
      if (upper(j, j) == 0) throw IntegrationError("changes of the start became dependent");
      result.col(j) = left / upper(j, j);
    }
    return result;
  }

  /// dq_i . dp_j - dp_i . dq_j of all pairs.
  Matrix<Mpfr> forms_of(const Matrix<Mpfr>& vectors) const {
    const Matrix<Mpfr> q = vectors.topRows(m_), p = vectors.bottomRows(m_);
    const Matrix<Mpfr> one = q.transpose() * p;
    return one - one.transpose();
  }
  Mpfr form_size(const Matrix<Mpfr>& vectors) const {
    Mpfr size = 0;
    for (Index i = 0; i < vectors.cols(); ++i)
      for (Index j = 0; j < vectors.cols(); ++j)
        raise_to(size, Mpfr(norm(Vector<Mpfr>(vectors.col(i).head(m_))) * norm(Vector<Mpfr>(vectors.col(j).tail(m_)))));
    return size;
  }

  /// Means without the first tenth, in which directions settle. Their uncertainty is twice that of the mean of eight
  /// parts.
  static std::vector<LyapunovExponent> exponents_of(const std::vector<double>& times,
                                                    const std::vector<std::vector<double>>& logs) {
    const std::size_t blocks = logs.size(), first = blocks / 10, parts = std::min<std::size_t>(8, blocks - first);
    std::vector<LyapunovExponent> exponents;
    for (std::size_t i = 0; i < logs.front().size(); ++i) {
      std::vector<double> rates;
      double sum = 0;
      for (std::size_t part = 0; part < parts; ++part) {
        const std::size_t from = first + (blocks - first) * part / parts,
                          to = first + (blocks - first) * (part + 1) / parts;
        double own = 0;
        for (std::size_t b = from; b < to; ++b) own += logs[b][i];
        sum += own;
        rates.push_back(own / (times[to - 1] - (from == 0 ? 0 : times[from - 1])));
      }
      const double mean = sum / (times.back() - (first == 0 ? 0 : times[first - 1]));
      double square = 0;
      for (const double rate : rates) square += (rate - mean) * (rate - mean);
      const auto count = static_cast<double>(parts);
      exponents.push_back({mean, parts > 1 ? 2 * std::sqrt(square / (count * (count - 1))) : HUGE_VAL});
    }
    std::stable_sort(exponents.begin(), exponents.end(),
                     [](const LyapunovExponent& a, const LyapunovExponent& b) { return a.value > b.value; });
    return exponents;
  }

  const RunRequest& request_;
  Assembled<Mpfr> scene_;
  const Problem<Mpfr>& problem_;
  TimeGrid<Mpfr> grid_;
  StateEvaluator<Mpfr> point_;
  Mpfr epsilon_;
  Index m_;
  MethodPtr method_;
  std::unique_ptr<Stepper<Mpfr>> main_;
  std::vector<std::unique_ptr<Stepper<Mpfr>>> neighbours_;
  PhaseState now_;
  std::optional<TangentSpace> space_;
  Matrix<Mpfr> basis_;  // of the tangent space at the present state, over the scales
};

}  // namespace

TangentDigits TangentDigits::of(const Precision& precision) {
  constexpr int of_double = 16, guard = 20;
  const int asked = std::max(of_double, static_cast<int>(precision.digits()));
  return {asked, 2 * asked + guard};
}

TangentMap tangent_map(const RunRequest& request, const std::function<void(double)>& progress) {
  const TangentDigits digits = TangentDigits::of(request.precision);
  const PrecisionScope scope(static_cast<unsigned>(digits.working));
  return TangentCourse(request, digits).follow(progress);
}

Vector<Mpfr> constant_sensitivity(const RunRequest& request, const std::string& constant) {
  const TangentDigits digits = TangentDigits::of(request.precision);
  const PrecisionScope scope(static_cast<unsigned>(digits.working));
  const auto known = request.scene.constants.find(constant);
  if (known == request.scene.constants.end()) throw InputError("the scene has no constant '" + constant + "'");
  const int small = digits.asked / 2 + 4;  // what the quotient neglects is of the order of its square
  const MethodPtr method = TangentCourse(request, digits).method();
  std::vector<PhaseState> ends;
  for (const char* const sign : {"+", "-"}) {
    RunRequest changed = request;
    changed.method = method;
    const std::string value = "(" + known->second.text() + ")" + sign + "10^(-" + std::to_string(small) + ")";
    changed.scene = with_number(request.scene, constant, Expression::parse(value));
    ends.push_back(TangentCourse(changed, digits).end());
  }
  const Mpfr width = 2 * pow(Mpfr(10), -small);
  Vector<Mpfr> change(2 * ends[0].q.size());
  change << Vector<Mpfr>((ends[0].q - ends[1].q) / width), Vector<Mpfr>((ends[0].p - ends[1].p) / width);
  return change;
}

}  // namespace hbvm::core
