#pragma once

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hbvm::core {

/// What an effect acts on, and so what its displacement x means.
enum class Acts {
  on_each_body,    ///< x is the body's position
  about_a_center,  ///< x = body - centre, for every body of `on`
  between_pairs,   ///< x = a - b, for every pair of `between`
  on_group         ///< a formula alone: the positions of several bodies, one after the other
};

/// What U depends on, and so which motions of space keep it.
enum class Symmetry {
  central,  ///< U(|x|): all rotations
  axial,    ///< U(|x|, n.x): the rotations about n
  planar,   ///< U(n.x): the rotations about n, and the translations across it
  computed  ///< known by equations for the motion alone
};

/// The n of an effect that is not central: the value of a vector key, and M times that for a mass matrix M.
struct EffectAxis {
  std::string_view key;
  bool times_mass = false;
};

/// The keys of an [[effect]] table besides those that say what it acts on.
struct EffectKey {
  std::string_view name;
  bool is_vector = false;
  std::string_view fallback = {};  ///< value if the key is absent; empty: the key is required
};

/// What an effect's formula may use, over any number type T with + - * / sqrt sin cos exp log sinh cosh tanh atan.
template <class T>
class Interaction {
 public:
  std::vector<T> x;                                            ///< displacement, one entry a dimension
  std::map<std::string, T, std::less<>> numbers;               ///< the effect's scalar keys
  std::map<std::string, std::vector<T>, std::less<>> vectors;  ///< the effect's vector keys
  std::map<std::string, long, std::less<>> whole_numbers;      ///< the scalar keys that are whole
  std::vector<T> mass_matrix;                                  ///< of an on_each_body effect: d x d, row by row
  std::vector<T> masses, charges;                              ///< of a, and of b or the centre (a centre has no mass)

  std::map<std::string, long, std::less<>> floors;  ///< the greatest whole number not above each scalar key

  const T& number(std::string_view key) const { return numbers.find(key)->second; }
  const std::vector<T>& vector(std::string_view key) const { return vectors.find(key)->second; }
  /// The value of a scalar key that is a whole number.
  std::optional<long> whole(std::string_view key) const {
    const auto found = whole_numbers.find(key);
    return found == whole_numbers.end() ? std::nullopt : std::optional<long>(found->second);
  }

  long floor(std::string_view key) const { return floors.find(key)->second; }

  /// |x|^2 and |x|.
  T squared_distance() const { return dot(x, x); }
  T distance() const {
    using std::sqrt;
    return sqrt(squared_distance());
  }

  /// M v for the body's mass matrix M, which is m times the identity for a scalar mass m.
  std::vector<T> mass_times(const std::vector<T>& v) const {
    std::vector<T> result;
    for (std::size_t i = 0; i < v.size(); ++i) {
      T sum = mass_matrix[i * v.size()] * v[0];
      for (std::size_t j = 1; j < v.size(); ++j) sum = sum + mass_matrix[i * v.size() + j] * v[j];
      result.push_back(sum);
    }
    return result;
  }

  static T dot(const std::vector<T>& a, const std::vector<T>& b) {
    T sum = a[0] * b[0];
    for (std::size_t i = 1; i < a.size(); ++i) sum = sum + a[i] * b[i];
    return sum;
  }
};

/// x^n for a whole n >= 1, by repeated squaring.
template <class T>
T power(const T& x, long n) {
  if (n == 1) return x;
  const T half = power(x, n / 2);
  return n % 2 == 0 ? half * half : half * half * x;
}

}  // namespace hbvm::core
