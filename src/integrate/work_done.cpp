#include "integrate/work_done.hpp"

#include "hbvm/error.hpp"

namespace hbvm::core {

template <Scalar S>
std::vector<std::size_t> working(const Problem<S>& problem, const std::string& name) {
  if (problem.driven.size() < 2)
    throw InputError("nothing does work here: no point moves, and all forces have a potential or do none");
  if (name.empty()) return working(problem);
  std::vector<std::size_t> found;
  std::string all;
  for (const std::size_t n : working(problem)) {
    const std::string& whole = problem.driven[n].name;  // "effect 2 (torque)", "point 'pivot'"
    if (whole == name || whole == "point '" + name + "'" || whole.starts_with(name + " (") ||
        whole.ends_with("(" + name + ")"))
      found.push_back(n);
    all += (all.empty() ? "" : ", ") + whole;
  }
  if (found.empty()) throw InputError("nothing that does work is called '" + name + "'; there is " + all);
  return found;
}

#define HBVM_DEFINE(S) template std::vector<std::size_t> working<S>(const Problem<S>&, const std::string&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
