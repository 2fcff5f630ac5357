#include "scalar/expression.hpp"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "expression_node.hpp"
#include "nearest.hpp"

namespace hbvm::core {
namespace {

using Node = Expression::Node;
using Kind = Node::Kind;
using NodePtr = std::shared_ptr<const Node>;

/// The text in quotes, its beginning if it is long.
std::string quoted(std::string_view text) {
  constexpr std::size_t most = 100;
  return text.size() <= most ? "'" + std::string(text) + "'" : "'" + std::string(text.substr(0, most)) + "...'";
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_name_start(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

constexpr std::array<std::pair<std::string_view, Kind>, 14> functions{{{"sqrt", Kind::sqrt},
                                                                       {"sin", Kind::sin},
                                                                       {"cos", Kind::cos},
                                                                       {"tan", Kind::tan},
                                                                       {"exp", Kind::exp},
                                                                       {"log", Kind::log},
                                                                       {"sinh", Kind::sinh},
                                                                       {"cosh", Kind::cosh},
                                                                       {"tanh", Kind::tanh},
                                                                       {"asin", Kind::asin},
                                                                       {"acos", Kind::acos},
                                                                       {"atan", Kind::atan},
                                                                       {"atan2", Kind::atan2},
                                                                       {"abs", Kind::abs}}};

/// Recursive descent over
///   sum     = product (('+' | '-') product)*
///   product = signed (('*' | '/') signed)*
///   signed  = ('+' | '-')* power
///   power   = primary ('^' signed)?
///   primary = decimal | name | function '(' sum ')' | 'atan2' '(' sum ',' sum ')' | '(' sum ')'
class Parser {
 public:
  Parser(std::string_view text, Expression::Syntax syntax) : text_(text), syntax_(syntax) {}

  NodePtr parse() {
    constexpr std::size_t longest = 100'000;
    if (is_formula() && text_.size() > longest) fail("begins a text that is too long");
    NodePtr root = sum();
    skip_blanks();
    if (at_ != text_.size()) fail("does not fit here" + product_meant());
    return root;
  }

 private:
  // Reading recurses into brackets, evaluation into the tree: neither may exhaust the stack.
  static constexpr int max_depth = 200;
  static constexpr std::size_t max_nodes = 1'000;

  [[noreturn]] void fail(const std::string& what) const {
    const std::string found = at_ < text_.size() ? "'" + std::string(1, text_[at_]) + "' " : "the end ";
    throw ExpressionError(text_, at_, found + what);
  }

  /// "2pi" and "2(a + b)" are products to those who write them.
  std::string product_meant() const {
    if (at_ == 0 || at_ == text_.size() || !(is_name_start(text_[at_]) || text_[at_] == '(')) return {};
    const std::string product = std::string(text_.substr(0, at_)) + "*" + std::string(text_.substr(at_));
    return "; a product is written " + quoted(std::string_view(product));
  }

  /// What stands at this place of the text.
  NodePtr make(std::size_t at, Kind kind, NodePtr left = nullptr, NodePtr right = nullptr, std::string text = {}) {
    if (++nodes_ > max_nodes) fail("comes after too many operations");
    return std::make_shared<const Node>(Node{kind, std::move(text), std::move(left), std::move(right), at});
  }

  /// Of a number that stands alone there is one line, and no name of a body.
  bool is_formula() const { return syntax_ != Expression::Syntax::number; }
  bool is_blank(char c) const { return c == ' ' || c == '\t' || (is_formula() && (c == '\n' || c == '\r')); }
  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }

  bool accept(char c) {
    skip_blanks();
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  NodePtr sum() {
    if (++depth_ > max_depth) fail("is nested too deeply");
    NodePtr left = product();
    for (;;) {
      const bool adds = accept('+');
      if (!adds && !accept('-')) break;
      const std::size_t sign = at_ - 1;
      NodePtr right = product();
      left = make(sign, adds ? Kind::add : Kind::subtract, std::move(left), std::move(right));
    }
    --depth_;
    return left;
  }

  NodePtr product() {
    NodePtr left = signed_power();
    for (;;) {
      const bool multiplies = accept('*');
      if (!multiplies && !accept('/')) return left;
      const std::size_t sign = at_ - 1;
      NodePtr right = signed_power();
      left = make(sign, multiplies ? Kind::multiply : Kind::divide, std::move(left), std::move(right));
    }
  }

  NodePtr signed_power() {
    bool negative = false;
    std::size_t sign = 0;
    for (;;) {
      if (accept('-')) {
        negative = !negative;
        sign = at_ - 1;
      } else if (!accept('+')) {
        break;
      }
    }
    NodePtr value = power();
    return negative ? make(sign, Kind::negate, std::move(value)) : value;
  }

  NodePtr power() {
    if (++depth_ > max_depth) fail("is nested too deeply");
    NodePtr base = primary();
    if (accept('^')) {
      const std::size_t sign = at_ - 1;
      NodePtr exponent = signed_power();
      base = make(sign, Kind::power, std::move(base), std::move(exponent));
    }
    --depth_;
    return base;
  }

  NodePtr primary() {
    skip_blanks();
    if (at_ == text_.size()) fail("comes where a number is expected");
    if (accept('(')) {
      NodePtr inner = sum();
      close();
      return inner;
    }
    if (is_digit(text_[at_]) || text_[at_] == '.') return decimal();
    if (is_name_start(text_[at_])) return name();
    fail("comes where a number is expected");
  }

  void close() {
    if (!accept(')')) fail("comes where ')' is expected" + product_meant());
  }

  NodePtr decimal() {
    const std::size_t start = at_;
    std::size_t digits = 0;
    const auto run = [&] {
      for (; at_ < text_.size() && is_digit(text_[at_]); ++at_) ++digits;
    };
    run();
    if (at_ < text_.size() && text_[at_] == '.') {
      ++at_;
      run();
    }
    if (digits == 0) fail("comes where a digit is expected");
    if (at_ < text_.size() && (text_[at_] == 'e' || text_[at_] == 'E')) {
      ++at_;
      if (at_ < text_.size() && (text_[at_] == '+' || text_[at_] == '-')) ++at_;
      digits = 0;
      run();
      if (digits == 0) fail("comes where a digit of the exponent is expected");
      if (digits > 6) fail("comes after an exponent out of range");
    }
    return make(start, Kind::decimal, nullptr, nullptr, std::string(text_.substr(start, at_ - start)));
  }

  void skip_word() {
    while (at_ < text_.size() && (is_name_start(text_[at_]) || is_digit(text_[at_]))) ++at_;
  }

  [[noreturn]] void unknown_function(std::size_t start, const std::string& word) const {
    std::vector<std::string> known;
    for (const auto& [function, kind] : functions) known.emplace_back(function);
    throw ExpressionError(text_, start,
                          "'" + word + "' is no function" + did_you_mean_or_list(word, known) +
                              "; if it is a name, a product is written " + word + "*(...)");
  }

  NodePtr name() {
    const std::size_t start = at_;
    skip_word();
    const auto has_point = [&] { return at_ + 1 < text_.size() && text_[at_] == '.' && is_name_start(text_[at_ + 1]); };
    for (int points = syntax_ == Expression::Syntax::observation ? 2
                      : is_formula()                             ? 1
                                                                 : 0;
         points > 0 && has_point(); --points) {
      ++at_;
      skip_word();
    }
    const std::string word(text_.substr(start, at_ - start));
    for (const auto& [function, kind] : functions) {
      if (word != function) continue;
      if (!accept('(')) fail("comes where '(' is expected after " + word);
      NodePtr argument = sum(), second;
      if (kind == Kind::atan2) {
        if (!accept(',')) fail("comes where ',' is expected: it is atan2(y, x)");
        second = sum();
      }
      close();
      return make(start, kind, std::move(argument), std::move(second));
    }
    if (word == "pi") return make(start, Kind::pi);
    if (syntax_ == Expression::Syntax::observation && accept('('))
      return make(start, Kind::name, nullptr, nullptr, word + arguments());
    if (at_ < text_.size() && text_[at_] == '(' && word.size() > 1) unknown_function(start, word);
    return make(start, Kind::name, nullptr, nullptr, word);
  }

  /// What stands in the brackets of a quantity, with one blank after each comma: "(a, b)".
  std::string arguments() {
    std::string text = "(";
    int open = 1;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      open += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
      if (open == 0) break;
      if (is_blank(c) && (text.back() == '(' || text.back() == ' ')) continue;
      text += is_blank(c) ? ' ' : c;
      if (c == ',') text += ' ';
    }
    while (text.back() == ' ') text.pop_back();
    close();
    return text + ")";
  }

  std::string_view text_;
  Expression::Syntax syntax_;
  std::size_t at_ = 0, nodes_ = 0;
  int depth_ = 0;
};

void collect_names(const Node& node, std::set<std::string>& names) {
  if (node.kind == Kind::name) names.insert(node.text);
  if (node.left) collect_names(*node.left, names);
  if (node.right) collect_names(*node.right, names);
}

}  // namespace

ExpressionError::ExpressionError(std::string_view text, std::size_t at, std::string reason)
    : InputError(quoted(text) + ", column " + std::to_string(at + 1) + ": " + reason),
      reason_(std::move(reason)),
      at_(at) {}

ExpressionError::ExpressionError(std::string_view text, std::string reason)
    : InputError("'" + std::string(text) + "': " + reason), reason_(std::move(reason)) {}

Expression Expression::parse(std::string_view text, Syntax syntax) {
  return {std::string(text), Parser(text, syntax).parse()};
}

const std::set<std::string, std::less<>>& Expression::reserved_words() {
  static const std::set<std::string, std::less<>> words = [] {
    std::set<std::string, std::less<>> all{"pi"};
    for (const auto& [word, kind] : functions) all.emplace(word);
    return all;
  }();
  return words;
}

std::set<std::string> Expression::names() const {
  std::set<std::string> names;
  collect_names(*root_, names);
  return names;
}

}  // namespace hbvm::core
