#include "motion.hpp"

#include <algorithm>

#include "integrate/integrate.hpp"
#include "linear/lu.hpp"
#include "problem/constraint_gradient.hpp"
#include "scalar/with_scalar.hpp"
#include "scene/assemble.hpp"
#include "step/hbvm_stepper.hpp"

namespace hbvm::core {
namespace {

constexpr long samples = 8;

template <Scalar S>
std::vector<BigFloat> exact(const Vector<S>& x) {
  std::vector<BigFloat> result;
  for (Index i = 0; i < x.size(); ++i) result.push_back(exactly(x[i]));
  return result;
}

/// Keeps samples, and the size of each coordinate over all mesh points.
template <Scalar S>
class Recorder final : public Observer<S> {
 public:
  Recorder(const Problem<S>& problem, const TimeGrid<S>& grid)
      : problem_(problem),
        potential_(problem.potential, 1),
        gradient_(problem, 1),
        steps_(grid.steps()),
        h_(grid.step()),
        v_(problem.m()),
        q_size_(Vector<S>::Zero(problem.m())),
        p_size_(q_size_),
        force_(1, problem.m()),
        reaction_(problem.m()) {}

  void observe(const Snapshot<S>& snapshot) override {
    problem_.mass.velocity(lanes(snapshot.p), lanes(v_));
    potential_.force(lanes(snapshot.q), force_);
    reaction_.setZero();
    gradient_.update(lanes(snapshot.q));
    gradient_.add_times(snapshot.lambda.transpose(), lanes(reaction_));
    for (Index i = 0; i < v_.size(); ++i) {
      raise_magnitude(q_size_[i], snapshot.q[i]);
      raise_magnitude(q_size_[i], S(h_ * v_[i]));
      raise_magnitude(p_size_[i], snapshot.p[i]);
      raise_magnitude(p_size_[i], S(h_ * force_(0, i)));
      raise_magnitude(p_size_[i], S(h_ * reaction_[i]));
    }
    const long n = snapshot.n, before = std::max(0L, n - 1);
    if (n == 0 || n * samples / steps_ > before * samples / steps_)
      seen_.push_back({exact(snapshot.q), exact(snapshot.p)});
  }

  std::vector<ExactState> take() { return std::move(seen_); }
  /// Of |q|, h |v| and h^2 |M^-1 force|, and of |p| and h |force|.
  ExactState scale() {
    problem_.mass.velocity(lanes(std::as_const(p_size_)), lanes(v_));
    for (Index i = 0; i < v_.size(); ++i) raise_magnitude(q_size_[i], S(h_ * v_[i]));
    return {exact(q_size_), exact(p_size_)};
  }

 private:
  const Problem<S>& problem_;
  PotentialEvaluator<S> potential_;
  ConstraintGradient<S> gradient_;
  long steps_;
  S h_;
  Vector<S> v_, q_size_, p_size_;
  Matrix<S> force_;
  Vector<S> reaction_;
  std::vector<ExactState> seen_;
};

/// Signs without a pattern.
bool positive(Index i) { return (7919 * (i + 1) + 4271) % 10'007 % 2 == 0; }

/// Changes each constraint and each hidden constraint by so much of its terms. It does so through the smallest changes
/// of positions and momenta that do, M^-1 grad g Gram^-1 r and grad g Gram^-1 r. Redundant constraints cannot be
/// changed one by one.
template <Scalar S>
void kick_constraints(const Problem<S>& problem, State<S>& state, const S& relative) {
  const Index nu = problem.nu();
  if (nu == 0) return;
  Vector<S> v(problem.m());
  problem.mass.velocity(lanes(state.p), lanes(v));
  ConstraintGradient<S> gradient(problem, 1);
  gradient.update(lanes(state.q));
  Matrix<S> gram(nu, nu);
  gradient.gram(gram);
  Lu<S> lu;
  lu.set(gram);
  if (!lu.factor()) return;
  Vector<S> positions(nu), momenta(nu);
  for (Index a = 0; a < nu; ++a) {
    S slope = 0, speed = 0;
    const auto& pattern = gradient.pattern(a);
    for (std::size_t c = 0; c < pattern.coordinates.size(); ++c) {
      slope += magnitude(gradient.values()(0, pattern.first + static_cast<Index>(c)));
      raise_magnitude(speed, v[pattern.coordinates[c]]);
    }
    const S signed_relative = positive(a) ? relative : S(-relative);
    momenta[a] = signed_relative * slope * speed;
    positions[a] =
        signed_relative * value(problem.constraints[static_cast<std::size_t>(a)], problem.dimension, state.q).size;
  }
  lu.solve(positions);
  lu.solve(momenta);
  gradient.add_weighted_times(positions.transpose(), lanes(state.q));
  gradient.add_times(momenta.transpose(), lanes(state.p));
}

template <Scalar S>
void kick(const Problem<S>& problem, State<S>& state, long bits) {
  S relative = 1;
  for (long i = 0; i < bits; ++i) relative /= 2;
  kick_constraints(problem, state, relative);
  for (Index i = 0; i < state.q.size(); ++i) {
    state.q[i] *= positive(2 * i) ? S(1 + relative) : S(1 - relative);
    state.p[i] *= positive(2 * i + 1) ? S(1 + relative) : S(1 - relative);
  }
}

/// Kicks the state at the start and at every eighth of the run, then makes the step.
template <Scalar S>
class KickingStepper final : public ForwardingStepper<S> {
 public:
  KickingStepper(Stepper<S>& inner, long bits, long steps)
      : ForwardingStepper<S>(inner), bits_(bits), every_(std::max(1L, steps / samples)) {}

  StepResult<S> step(State<S>& state, const S& h) override {
    if (bits_ > 0 && made_++ % every_ == 0) kick(this->problem(), state, bits_);
    return this->inner().step(state, h);
  }
  void remember(Archive& archive) override {
    ForwardingStepper<S>::remember(archive);
    archive(made_);
  }

 private:
  long bits_, every_, made_ = 0;
};

template <Scalar S>
SampledMotion motion_in(const RunRequest& request, const Twist& twist) {
  const TimeGrid<S> grid(request.step, request.until, request.scene.constants);
  const Assembled<S> scene = assemble<S>(request.scene);
  const StepperMaker<S> make_stepper = request.method->prepare(scene.problem, request.solver);
  State<S> state(scene.q0, scene.p0);
  const auto run = [&] {
    Recorder<S> recorder(scene.problem, grid);
    const std::unique_ptr<Stepper<S>> plain = make_stepper();
    KickingStepper<S> stepper(*plain, twist.kick_bits, grid.steps());
    integrate<S>(stepper, state, grid, {&recorder});
    return SampledMotion{recorder.take(), recorder.scale(), grid.steps()};
  };
  SampledMotion motion = run();
  if (!twist.back) return motion;
  state.p = -state.p;
  state.p_carry = -state.p_carry;
  const SampledMotion back = run();
  motion.steps += back.steps;
  motion.samples.push_back(back.samples.back());
  return motion;
}

}  // namespace

SampledMotion motion_of(const RunRequest& request, const Twist& twist) {
  return with_scalar(request.precision, [&]<Scalar S>() { return motion_in<S>(request, twist); });
}

}  // namespace hbvm::core
