#pragma once

#include <vector>

#include "linear/aligned_series.hpp"
#include "linear/growing_convolution.hpp"
#include "problem/effect/program.hpp"

namespace hbvm::core {

/// The Taylor coefficients of a program's outputs where its inputs are power series, one recurrence an operation
/// (Griewank and Walther, Evaluating Derivatives, 2008, chapter 13). With z_n for z^(n)/n!,
///
///     z = a b      z_n = sum_{i <= n} a_i b_{n-i}
///     z = 1/a      z_n = -z_0 sum_{1 <= i <= n} a_i z_{n-i}
///     z = sqrt a   z_n = (a_n - sum_{0 < i < n} z_i z_{n-i}) / (2 z_0)
///     z = exp a    n z_n = sum_{1 <= i <= n} i a_i z_{n-i}
///     z = log a    n a_0 z_n = n a_n - sum_{0 < i < n} i z_i a_{n-i}
///     s = sin a, c = cos a, together: n s_n = sum i a_i c_{n-i}, n c_n = -sum i a_i s_{n-i}
///     s = sinh a, c = cosh a, likewise, without the sign
///     z = tanh a   n z_n = n a_n - sum_{1 <= i <= n} i a_i w_{n-i}, w = z^2
///     z = atan a   n w_0 z_n = n a_n - sum_{0 < i < n} i z_i w_{n-i}, w = 1 + a^2
class ProgramSeries {
 public:
  /// Series up to degree `order`. The first inputs vary; the others are numbers, `coefficients`, that outlive this.
  ProgramSeries(const Program<Mpfr>& program, Index inputs, std::vector<const Mpfr*> coefficients, Index order);

  /// Coefficient n of an input, to be set before advance(n).
  Mpfr& input(Index i, Index n) { return series(i)[n]; }
  const Mpfr& input(Index i, Index n) const { return series(i)[n]; }
  /// Computes coefficient n of everything; those below are known.
  /// \throws IntegrationError where an operation has no series: a division by 0, a root or logarithm of what is not
  /// positive, a magnitude at 0
  void advance(Index n);
  const Mpfr& output(std::size_t i, Index n) const;

 private:
  /// A series, or a number that does not vary.
  struct Value {
    Index series = -1;
    const Mpfr* number = nullptr;
  };
  struct Node {
    Op op;
    Value a, b;
    Index z;                ///< its series
    Index aux = -1;         ///< i a_i of sin, cos, sinh, cosh, tanh and exp, i z_i of log and atan
    Index other = -1;       ///< cos of a sin, sin of a cos, likewise of sinh and cosh; w of tanh and atan
    bool computed = false;  ///< by the node of the other
    Index sums = -1;        ///< its first convolution; that of a second one follows
  };
  Mpfr* series(Index i) { return &values_[static_cast<std::size_t>(i * (order_ + 1))]; }
  const Mpfr* series(Index i) const { return &values_[static_cast<std::size_t>(i * (order_ + 1))]; }
  const Mpfr& at(const Value& x, Index n) const;
  /// Series i is one of a convolution.
  void align(Index i);
  AlignedSeries& aligned(Index i) { return aligned_[static_cast<std::size_t>(position_[static_cast<std::size_t>(i)])]; }
  /// Coefficient n of series i is known.
  void keep(Index i, Index n);
  /// The convolutions of a node, each from these coefficients of its factors on.
  void add_convolutions(Node& node, std::initializer_list<std::pair<Index, Index>> from);
  /// Coefficient n of the convolution of this number.
  void set_convolution(Mpfr& r, Index sums, Index a, Index b, Index n);
  /// r = sum_{first <= i <= n - first} a_i a_{n-i}, likewise: equal terms once.
  void set_square(Mpfr& r, Index sums, Index a, Index n, Index first, Mpfr& t);
  void linear(const Node& node, Index n);
  void multiply(const Node& node, Index n);
  void start(const Node& node);
  void go_on(const Node& node, Index n);

  Index order_, inputs_;
  std::vector<Node> nodes_;
  std::vector<Value> outputs_;
  std::vector<Mpfr> values_;  ///< series after series
  std::vector<AlignedSeries> aligned_;
  std::vector<GrowingConvolution> convolutions_;
  std::vector<Index> position_;  ///< of a series in aligned_, or -1
  Mpfr zero_ = 0, t_ = 0;
};

}  // namespace hbvm::core
