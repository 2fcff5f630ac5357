#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "linear/matrix.hpp"
#include "scalar/expression.hpp"
#include "scalar/literal.hpp"
#include "scalar/mpfr.hpp"

namespace hbvm::core {

/// The scalars of coefficients: double to search, and any number of digits to judge.
#define HBVM_FOR_EACH_SCALAR_OF_SCHEMES(F) F(double) F(Mpfr)

/// One number of a scheme as its author writes it.
struct SchemeEntry {
  std::string key;  ///< of its array
  std::size_t row = 0, column = 0;
  std::string name;                     ///< "A[3][2]", from 1
  std::optional<Expression> written{};  ///< none if it is unknown, "?"
};

/// Numbers by rows, as an author writes them; one row of a vector. Each is the place of an entry.
struct SchemeBlock {
  std::size_t rows = 0, columns = 0;
  std::vector<std::size_t> places;  ///< row by row
};

struct SchemeText;

/// What a scheme promises: the order that one set of its weights has.
struct SchemePart {
  std::string name;             ///< "order", "embedded order"
  int max_order = 0;            ///< up to which its conditions are known
  std::optional<int> stated{};  ///< that the author claims
};

/// The coefficients of a method of some family, and its order conditions as functions of them. Values stand in the
/// order of the entries.
class Scheme {
 public:
  virtual ~Scheme() = default;

  const std::string& name() const { return name_; }
  /// "runge_kutta", "splitting"
  virtual std::string family() const = 0;
  const std::vector<SchemeEntry>& entries() const { return entries_; }
  const std::vector<SchemePart>& parts() const { return parts_; }

  /// Those of the entries, rounded once; 0 for what is unknown.
  template <class S>
  std::vector<S> written_values() const;

  /// Numbers of a block, in the scalar of the values.
  template <class S>
  Matrix<S> matrix(const std::string& block, const std::vector<S>& values) const {
    const SchemeBlock& of = blocks_.at(block);
    Matrix<S> result(static_cast<Index>(of.rows), static_cast<Index>(of.columns));
    for (std::size_t i = 0; i < of.rows; ++i)
      for (std::size_t j = 0; j < of.columns; ++j)
        result(static_cast<Index>(i), static_cast<Index>(j)) = values[of.places[i * of.columns + j]];
    return result;
  }
  /// Those of a block of one row.
  template <class S>
  Vector<S> vector(const std::string& block, const std::vector<S>& values) const {
    return matrix(block, values).row(0).transpose();
  }
  bool has(const std::string& block) const { return blocks_.contains(block); }

  /// How far off the conditions of exactly this order are: a sum over its value, less 1, or a sum that should be 0.
#define HBVM_DECLARE(S) \
  virtual std::vector<S> residuals(std::size_t part, int order, const std::vector<S>& values) const = 0;
  HBVM_FOR_EACH_SCALAR_OF_SCHEMES(HBVM_DECLARE)
#undef HBVM_DECLARE
  /// How far off is what must hold at any order, as c = A 1.
#define HBVM_DECLARE(S) \
  virtual std::vector<S> consistency(const std::vector<S>&) const { return {}; }
  HBVM_FOR_EACH_SCALAR_OF_SCHEMES(HBVM_DECLARE)
#undef HBVM_DECLARE

 protected:
  /// Numbers of the first row of an array. \throws InputError if it is missing
  static std::size_t row_length(const SchemeText& text, const std::string& key);
  /// Makes entries of an array. \throws InputError if it is missing or has another shape, and naming a flawed number
  void take(const SchemeText& text, const std::string& key, std::size_t rows, std::size_t columns);
  /// \param key of the order that the author may state. \throws InputError if that is out of reach
  void add_part(const SchemeText& text, const std::string& name, const std::string& key, int max_order);

  std::string name_;
  std::vector<SchemeEntry> entries_;
  std::map<std::string, SchemeBlock> blocks_;
  std::vector<SchemePart> parts_;
};

using SchemePtr = std::shared_ptr<const Scheme>;

/// A scheme whose residuals_in() and consistency_in() are templates.
template <class Own>
class SchemeByTemplate : public Scheme {
 public:
#define HBVM_DECLARE(S)                                                                                \
  std::vector<S> residuals(std::size_t part, int order, const std::vector<S>& values) const override { \
    return own().residuals_in(part, order, values);                                                    \
  }                                                                                                    \
  std::vector<S> consistency(const std::vector<S>& values) const override { return own().consistency_in(values); }
  HBVM_FOR_EACH_SCALAR_OF_SCHEMES(HBVM_DECLARE)
#undef HBVM_DECLARE

 private:
  const Own& own() const { return static_cast<const Own&>(*this); }
};

}  // namespace hbvm::core
