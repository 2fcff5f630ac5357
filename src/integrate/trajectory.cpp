#include "integrate/trajectory.hpp"

#include <ostream>

#include "csv_line.hpp"
#include "integrate/output_state.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
void write(std::ostream& out, const Vector<S>& v) {
  for (Index i = 0; i < v.size(); ++i) out << ',' << to_text(v[i]);
}

}  // namespace

template <Scalar S>
Trajectory<S>::Trajectory(const Problem<S>& problem, std::ostream& out, long every, long steps,
                          const std::vector<std::string>& columns, const Observations<S>* observations)
    : problem_(problem),
      point_(problem),
      redundant_(problem),
      out_(out),
      every_(every),
      steps_(steps),
      columns_(columns),
      observations_(observations) {}

template <Scalar S>
void Trajectory<S>::observe(const Snapshot<S>& s) {
  if (s.n == 0) out_ << csv_line(columns_) << '\n';
  const bool wanted = s.n % every_ == 0 || s.n == steps_;
  if (!wanted) return;
  const S H = point_.energy(s.q, s.p);
  if (s.n == 0) H0_ = H;
  out_ << to_text(s.t);
  const Index bodies = problem_.mass.of_bodies();
  write(out_, Vector<S>(s.q.head(bodies)));
  write(out_, Vector<S>(s.p.head(bodies)));
  write(out_, redundant_.multipliers(s.q, s.lambda));
  const OutputState<S> output = output_state(point_, s.q, s.p);
  write(out_, Vector<S>(output.p.head(bodies)));
  write(out_, redundant_.multipliers(s.q, output.lambda));
  S g = max_norm(point_.constraints(s.q)), hidden = max_norm(point_.hidden_constraints(s.q, s.p));
  raise_to(g, max_norm(redundant_.values(s.q)));
  raise_to(hidden, max_norm(redundant_.hidden(s.q, s.p)));
  out_ << ',' << to_text(S(H - H0_)) << ',' << to_text(g) << ',' << to_text(hidden);
  if (observations_) write(out_, observations_->values());
  out_ << '\n';
}

#define HBVM_DEFINE(S) template class Trajectory<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
