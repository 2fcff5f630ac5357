#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "problem/effect/program.hpp"
#include "problem/space/displacement.hpp"

namespace hbvm::core {

/// A body, a body and a fixed point, or a pair, with displacement x = q_a + shift or x = q_a - q_b.
struct KernelSite {
  Index a;
  Index b = -1;  ///< -1: none
  std::array<double, 3> shift{};
  const double* coefficients = nullptr;
};

/// A program in double that was compiled with the library. Interpreting costs about as much as the arithmetic in
/// double, and next to nothing in more digits. The kernels are printed by effect_kernels from the same traces that are
/// interpreted elsewhere, and do the same operations in the same order.
struct Kernel {
  std::string_view code;  ///< text of the program it was made from
  /// force += dU/dx of every site in every lane, for one effect after the other if the program is of several.
  void (*add_force)(const KernelSite* sites, std::size_t count, Lanes<const double> q, double* force);
};

/// The program as C++ statements that read x[0 .. dimension) and the coefficients c[...], and write g[...].
std::string cpp_text(const Program<double>& program, Index dimension);
/// The same for all lanes, in loops. One calls a function for each lane, as a sine, and the next takes several lanes at
/// a time. x_of(i, x) gives the displacement in lane i, add(i, g) takes the gradient. t[n][i] is scratch for each
/// temporary. Empty if no function is called, or one of a number that is no temporary.
std::string cpp_steps(const Program<double>& program, Index dimension);

/// The kernel of this program; none if it was not compiled, as for a rare exponent.
const Kernel* find_kernel(const Program<double>& program, Index dimension);

/// The site of a displacement; none for the centre of a rigid body, which has more blocks.
std::optional<KernelSite> kernel_site(const Displacement<double>& x);

/// A kernel and all that it acts on.
class KernelUse {
 public:
  KernelUse(KernelUse&&) = default;
  KernelUse& operator=(KernelUse&&) = default;

  /// \param coefficients a row for each displacement
  /// \return none if the program was not compiled, or a displacement has no site
  static std::optional<KernelUse> find(const Program<double>& program, Index dimension,
                                       const std::vector<Displacement<double>>& displacements,
                                       const Matrix<double>& coefficients);

  void add_force(Lanes<const double> q, double* force) const {
    kernel_->add_force(sites_.data(), sites_.size(), q, force);
  }

 private:
  KernelUse() = default;

  const Kernel* kernel_ = nullptr;
  std::vector<KernelSite> sites_;
  std::vector<std::vector<double>> coefficients_;  ///< of each site, which points to them
};

}  // namespace hbvm::core
