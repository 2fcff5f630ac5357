#include "hbvm/integrate/trajectory.hpp"

#include <algorithm>
#include <ostream>

#include "hbvm/integrate/output_state.hpp"
#include "hbvm/scalar/text.hpp"

namespace hbvm {
namespace {

template <Scalar S>
void write(std::ostream& out, const Vector<S>& v) {
  for (Index i = 0; i < v.size(); ++i) out << ',' << to_text(v[i]);
}

}  // namespace

template <Scalar S>
Trajectory<S>::Trajectory(const Problem<S>& problem, std::ostream& out, long every, long steps,
                          const std::vector<std::string>& provenance)
    : problem_(problem),
      point_(problem),
      redundant_(problem),
      out_(out),
      every_(every),
      steps_(steps),
      provenance_(provenance) {}

template <Scalar S>
void Trajectory<S>::begin() {
  out_ << "# t";
  const auto names = [&](const char* name, Index count) {
    for (Index i = 1; i <= count; ++i) out_ << ',' << name << i;
  };
  const Index constraints = problem_.nu() + static_cast<Index>(problem_.redundant.size());
  names("q", problem_.m());
  names("p", problem_.m());
  names("lambda", constraints);
  names("output_p", problem_.m());
  names("output_lambda", constraints);
  out_ << ",delta_H,g,hidden\n";
  for (std::string line : provenance_) {
    std::replace(line.begin(), line.end(), '\n', ' ');
    out_ << "# " << line << '\n';
  }
}

template <Scalar S>
void Trajectory<S>::observe(const Snapshot<S>& s) {
  if (s.n == 0) begin();
  const bool wanted = s.n % every_ == 0 || s.n == steps_;
  if (!wanted) return;
  const S H = point_.energy(s.q, s.p);
  if (s.n == 0) H0_ = H;
  out_ << to_text(s.t);
  write(out_, s.q);
  write(out_, s.p);
  write(out_, redundant_.multipliers(s.q, s.lambda));
  const OutputState<S> output = output_state(point_, s.q, s.p);
  write(out_, output.p);
  write(out_, redundant_.multipliers(s.q, output.lambda));
  S g = max_norm(point_.constraints(s.q)), hidden = max_norm(point_.hidden_constraints(s.q, s.p));
  raise_to(g, max_norm(redundant_.values(s.q)));
  raise_to(hidden, max_norm(redundant_.hidden(s.q, s.p)));
  out_ << ',' << to_text(S(H - H0_)) << ',' << to_text(g) << ',' << to_text(hidden) << '\n';
}

#define HBVM_DEFINE(S) template class Trajectory<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
