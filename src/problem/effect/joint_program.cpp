#include "problem/effect/joint_program.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace hbvm::core {
namespace {

/// The code of one program after another, where what was computed before is not computed again. Each instruction has a
/// temporary of its own.
template <Scalar S>
class Joining {
 public:
  explicit Joining(std::size_t inputs) : inputs_(inputs), next_coefficient_(inputs) {}

  void add(const JointPart<S>& part) {
    // The temporary that stands for each of the program's own, which it may write several times.
    std::vector<std::uint32_t> stands_for(part.program->temporaries());
    const auto joint = [&](const Operand& x) {
      if (x.bank == Bank::constant) return constant(part.program->constants()[x.index]);
      if (x.bank == Bank::temporary) return Operand{Bank::temporary, stands_for[x.index]};
      return x.index < inputs_
                 ? x
                 : Operand{Bank::input, static_cast<std::uint32_t>(x.index - inputs_ + next_coefficient_)};
    };
    for (const Instruction& i : part.program->instructions())
      stands_for[i.result] = result_of(i.op, joint(i.a), is_binary(i.op) ? joint(i.b) : Operand{});
    for (const Operand& x : part.program->output_operands()) outputs_.push_back(joint(x));
    ends_.push_back(code_.size());
    next_coefficient_ += part.coefficients;
  }

  JointProgram<S> take() {
    const std::uint32_t registers = reuse_registers(code_, outputs_);
    return {{std::move(constants_), std::move(code_), std::move(outputs_), registers}, std::move(ends_)};
  }

 private:
  Operand constant(const S& value) {
    const auto found = std::find(constants_.begin(), constants_.end(), value);
    const auto index = static_cast<std::uint32_t>(found - constants_.begin());
    if (found == constants_.end()) constants_.push_back(value);
    return {Bank::constant, index};
  }
  std::uint32_t result_of(Op op, const Operand& a, const Operand& b) {
    const auto next = static_cast<std::uint32_t>(code_.size());
    const auto [known, is_new] = known_.try_emplace({op, a.bank, a.index, b.bank, b.index}, next);
    if (is_new) code_.push_back({op, a, b, next});
    return known->second;
  }

  std::size_t inputs_, next_coefficient_;
  std::vector<S> constants_;
  std::vector<Instruction> code_;
  std::vector<Operand> outputs_;
  std::vector<std::size_t> ends_;
  std::map<std::tuple<Op, Bank, std::uint32_t, Bank, std::uint32_t>, std::uint32_t> known_;
};

}  // namespace

template <Scalar S>
JointProgram<S> join(const std::vector<JointPart<S>>& parts, std::size_t inputs) {
  Joining<S> joining(inputs);
  for (const JointPart<S>& part : parts) joining.add(part);
  return joining.take();
}

#define HBVM_DEFINE(S) template JointProgram<S> join<S>(const std::vector<JointPart<S>>&, std::size_t);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
