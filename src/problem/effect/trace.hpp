#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "problem/effect/program.hpp"
#include "scalar/scalar.hpp"

namespace hbvm::core {

/// A formula as a graph of operations, recorded by evaluating it once on Traced values. Equal operations are kept once,
/// constants are folded, and constant factors move outwards. So the Program compiled from it does what one would write
/// by hand.
///
/// The order in which operations are recorded decides in which order the terms of a derivative are added, and so its
/// last digit. Which of two operands is computed first, the language leaves to the compiler. So where both vary, a
/// formula names one of them before it uses it.
///
/// Leaves are inputs (what the formula is differentiated by), parameters (one value per body or pair, as a mass)
/// and constants (the same for all).
template <Scalar S>
class Trace {
 public:
  using Id = std::size_t;
  static constexpr int not_polynomial = -1;

  Id input(std::size_t index) { return leaf(Kind::input, index); }
  Id parameter(std::size_t index) { return leaf(Kind::parameter, index); }
  Id constant(const S& value);

  Id add(Id a, Id b);
  Id subtract(Id a, Id b);
  Id multiply(Id a, Id b);
  Id apply(Op function, Id a);

  /// How much has been recorded.
  std::size_t size() const { return nodes_.size(); }
  /// Degree of the polynomial in the inputs that `a` is, or not_polynomial.
  int degree(Id a) const { return nodes_[a].degree; }

  /// d output / d input_i, i < inputs, by one backward sweep.
  std::vector<Id> gradient(Id output, std::size_t inputs);

  /// The program that computes `outputs` from inputs and parameters. What depends on parameters alone becomes a
  /// coefficient: an extra input that `coefficients` computes once from the parameters.
  struct Compiled {
    Program<S> program;       ///< inputs: the inputs, then the coefficients
    Program<S> coefficients;  ///< inputs: the parameters
  };
  Compiled compile(const std::vector<Id>& outputs, std::size_t inputs, std::size_t parameters) const;

 private:
  enum class Kind { input, parameter, constant, operation };
  struct Node {
    Kind kind;
    Op op;          // of an operation
    std::size_t a;  // operands, or the index of a leaf
    std::size_t b;
    S value;  // of a constant
    int degree;
    bool varies;  // depends on an input
  };

  Id leaf(Kind kind, std::size_t index);
  class Compiler;

  Id operation(Op op, Id a, Id b, int degree);
  bool is_constant(Id a) const { return nodes_[a].kind == Kind::constant; }
  bool is_constant(Id a, int value) const { return is_constant(a) && nodes_[a].value == value; }
  bool is(Op op, Id a) const { return nodes_[a].kind == Kind::operation && nodes_[a].op == op; }
  /// The factor c of a = c x with x varying and c not, if `a` was written so.
  bool has_coefficient(Id a) const { return is(Op::multiply, a) && !nodes_[nodes_[a].a].varies && nodes_[a].varies; }

  std::vector<Node> nodes_;
  std::vector<Id> constants_;
  std::map<std::tuple<int, int, Id, Id>, Id> known_;
};

/// A value that records what is done with it.
template <Scalar S>
class Traced {
 public:
  Traced(Trace<S>& trace, typename Trace<S>::Id id) : trace_(&trace), id_(id) {}

  typename Trace<S>::Id id() const { return id_; }

  friend Traced operator+(const Traced& a, const Traced& b) { return {*a.trace_, a.trace_->add(a.id_, b.id_)}; }
  friend Traced operator-(const Traced& a, const Traced& b) { return {*a.trace_, a.trace_->subtract(a.id_, b.id_)}; }
  friend Traced operator*(const Traced& a, const Traced& b) { return {*a.trace_, a.trace_->multiply(a.id_, b.id_)}; }
  friend Traced operator/(const Traced& a, const Traced& b) { return a * b.apply(Op::reciprocal); }
  friend Traced operator-(const Traced& a) { return a.whole(-1) * a; }
  friend Traced operator+(const Traced& a, int b) { return a + a.whole(b); }
  friend Traced operator-(const Traced& a, int b) { return a + a.whole(-b); }
  friend Traced operator-(int a, const Traced& b) { return b.whole(a) - b; }
  friend Traced operator*(int a, const Traced& b) { return b.whole(a) * b; }
  friend Traced operator/(int a, const Traced& b) { return b.whole(a) / b; }
  friend Traced operator/(const Traced& a, int b) { return a / a.whole(b); }
  friend Traced abs(const Traced& a) { return a.apply(Op::abs); }
  friend Traced sqrt(const Traced& a) { return a.apply(Op::sqrt); }
  friend Traced sin(const Traced& a) { return a.apply(Op::sin); }
  friend Traced cos(const Traced& a) { return a.apply(Op::cos); }
  friend Traced exp(const Traced& a) { return a.apply(Op::exp); }
  friend Traced log(const Traced& a) { return a.apply(Op::log); }
  friend Traced sinh(const Traced& a) { return a.apply(Op::sinh); }
  friend Traced cosh(const Traced& a) { return a.apply(Op::cosh); }
  friend Traced tanh(const Traced& a) { return a.apply(Op::tanh); }
  friend Traced atan(const Traced& a) { return a.apply(Op::atan); }

 private:
  Traced whole(int value) const { return {*trace_, trace_->constant(S(value))}; }
  Traced apply(Op function) const { return {*trace_, trace_->apply(function, id_)}; }
  Trace<S>* trace_;
  typename Trace<S>::Id id_;
};

}  // namespace hbvm::core
