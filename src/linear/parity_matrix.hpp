#pragma once

#include <concepts>
#include <type_traits>

#include "linear/aligned_matrix.hpp"
#include "linear/constant_count.hpp"
#include "linear/operation_counts.hpp"
#include "linear/product.hpp"

namespace hbvm::core {

/// Values of functions at nodes that lie symmetrically about 1/2. The functions are even and odd about it by turns,
/// like the Legendre polynomials and their integrals from 1/2. So a(n-1-i, j) = a(i, j) for an even j-th function,
/// -a(i, j) for an odd one. Nodes stand for rows or for columns.
///
/// Products take half of the multiplications of a full matrix. Sums over the even functions and those over the odd ones
/// give a node by their sum, its mirror by their difference. For sums over nodes it is the other way round. A matrix
/// whose entries do not mirror each other to a few units in the last place is multiplied as it stands. So is a small
/// one in double, where the loops cost more than the multiplications.
template <Scalar S>
class ParityMatrix {
 public:
  enum class Nodes { rows, columns };
  enum class First { even, odd };  ///< the function of index 0

  ParityMatrix(const Matrix<S>& a, Nodes nodes, First first);

  /// c = a b, resized.
  void times(Matrix<S>& c, const Matrix<S>& b);
  /// The same with its numbers of rows and columns, which may be constants. Then c must have its size, and it is so
  /// small a matrix of double that it is multiplied as it stands.
  template <class Rows, class Terms>
  [[gnu::always_inline]] void times(Rows, Terms, Matrix<S>& c, const Matrix<S>& b) {
    if constexpr (is_constant_count<Rows> && is_constant_count<Terms>)
      multiply_few<Rows::value, Terms::value>(c.data(), whole_.a.data(), b.data(), c.cols());
    else
      times(c, b);
  }
  /// c_ij = (a b)_ij + plus_j, likewise.
  template <class Rows, class Terms>
  [[gnu::always_inline]] void times_plus(Rows, Terms, Matrix<S>& c, const Matrix<S>& b, const Vector<S>& plus) {
    if constexpr (is_constant_count<Rows> && is_constant_count<Terms>) {
      multiply_few<Rows::value, Terms::value>(c.data(), whole_.a.data(), b.data(), c.cols(), plus.data());
    } else {
      times(c, b);
      add(c, plus);
    }
  }
  /// What times() takes for so many columns of b.
  OperationCounts operations(Index columns) const;
  /// Whether they take half of the multiplications.
  bool is_mirrored() const { return mirrored_; }

 private:
  bool is_even(Index function) const { return (function % 2 == 0) == (first_even_ == 0); }
  bool find_mirrored(const Matrix<S>& a) const;
  struct NotAligned {};
  struct Part {
    Matrix<S> a;
    std::conditional_t<std::same_as<S, Mpfr>, AlignedMatrix, NotAligned> aligned;
    explicit Part(Matrix<S> matrix = {});
    void times(S* r, const S* x, Index stride);
  };
  static void add(Matrix<S>& c, const Vector<S>& plus);
  /// r_{first + 2 i} = (a x)_i.
  void take_turns(S* r, Index first, Part& part, const S* x);

  Nodes nodes_;
  Index n_, functions_;           ///< numbers of nodes and functions
  Index first_even_, first_odd_;  ///< functions
  Part whole_;                    ///< if it is not mirrored
  Part even_, odd_;               ///< those functions at the first half of the nodes, the middle one with the even
  Vector<S> even_half_, odd_half_, turns_;  ///< scratch
  bool mirrored_ = false;
};

}  // namespace hbvm::core
