#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ball_program.hpp"
#include "problem/problem.hpp"

namespace hbvm::core {

/// Looks at the forces between the points at which a step knows them. On a closed curve about the step in complex time
/// positions are polynomials. Each force must be analytic inside, and on the curve not much larger than what the step
/// is made of. Then the part of its series that the step leaves out is bounded by Cauchy's estimate. A force of short
/// range that no point of a step feels is huge there, or singular.
class ForceBounds {
 public:
  /// The problem must outlive it.
  explicit ForceBounds(const Problem<Mpfr>& problem);

  /// Begins with the step that starts at this state.
  void start(const Vector<Mpfr>& q, const Vector<Mpfr>& p);
  /// The input of a force along the curve. Forces are the instances of the effects, one after another, and then the
  /// constraints by formulas.
  using LoopOf = std::function<Loop(std::size_t force, Index input)>;
  /// Whether along the curve each force changes momenta by at most 2^allowed_bits times what they consist of, body by
  /// body. The step has the length 2^log2_h. Each formula's gradient, too, may be as much larger than at the start.
  /// \param forces likewise of the forces without a potential: all x, then all v of an instance
  /// \param time of driven points, which may not be much farther along the curve than they move in the step
  bool hold(double log2_h, const LoopOf& loop, const LoopOf& forces = {}, const std::function<Loop()>& time = {});
  /// log2 of what each block's momentum consists of: itself, and what forces do to it in so long a time.
  std::vector<double> scales(double log2_h) const;
  /// log2 of what hold() allows each output of that force's gradient to be.
  std::vector<double> limits(std::size_t force, double log2_h) const;
  /// Why hold() was false: "effect 'formula': a division by 0".
  const std::string& obstacle() const { return obstacle_; }

  static constexpr double allowed_bits = 8;

  struct Force {
    const EffectTerm<Mpfr>* term;
    Index instance;
    std::string name;
    bool is_constraint;
    BallProgram program;
    double log2_size = 0;  ///< of its greatest component at the start, by what it consists of
    /// The displacement of an input.
    const Displacement<Mpfr>& displacement(Index input, Index dimension) const {
      return term->displacement(instance, input / dimension);
    }
  };
  const std::vector<Force>& forces() const { return forces_; }

  /// A force without a potential, of one instance.
  struct Pull {
    const ForceTerm<Mpfr>* term;
    Index instance;
    BallProgram program;
  };
  const std::vector<Pull>& pulls() const { return pulls_; }

 private:
  /// Of a pull, as limits() is of an effect.
  std::vector<double> pull_limits(const Pull& pull, double log2_h) const;
  std::vector<double> course_limits(std::size_t point, double log2_h) const;
  /// Notes how large a force of an output is on the bodies that it acts on.
  void note_force(const Displacement<Mpfr>& of, double log2_size);
  /// The least of what the bodies of an output allow.
  double limit_of(const Displacement<Mpfr>& of, const std::vector<double>& scale, double log2_h) const;
  bool fails(const std::string& name, const BallProgram& program);
  void add(const EffectTerm<Mpfr>& term, Index instance, std::string name, bool is_constraint);

  const Problem<Mpfr>& problem_;
  std::vector<Force> forces_;
  std::vector<std::size_t> block_of_;  ///< of each coordinate
  /// log2, of each block: of its momentum, of the forces on it, of its inertia.
  std::vector<double> momentum_, force_, inertia_;
  double reach_ = 0, speed_ = 0;  ///< log2 of the greatest |q_i|, |v_i|
  std::vector<Pull> pulls_;
  std::vector<BallProgram> courses_;
  Vector<Mpfr> driven_;  ///< X, X', X'' of each driven point
  std::string obstacle_;
};

}  // namespace hbvm::core
