#include "hbvm/scalar/expression.hpp"

#include <array>
#include <cstddef>
#include <utility>

#include "expression_node.hpp"

namespace hbvm {
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

constexpr std::array<std::pair<std::string_view, Kind>, 5> functions{
    {{"sqrt", Kind::sqrt}, {"sin", Kind::sin}, {"cos", Kind::cos}, {"exp", Kind::exp}, {"log", Kind::log}}};

/// Recursive descent over
///   sum     = product (('+' | '-') product)*
///   product = signed (('*' | '/') signed)*
///   signed  = ('+' | '-')* power
///   power   = primary ('^' signed)?
///   primary = decimal | name | function '(' sum ')' | '(' sum ')'
class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  NodePtr parse() {
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
    throw ExpressionError(quoted(text_) + ", column " + std::to_string(at_ + 1) + ": " + found + what);
  }

  /// "2pi" and "2(a + b)" are products to those who write them.
  std::string product_meant() const {
    if (at_ == 0 || at_ == text_.size() || !(is_name_start(text_[at_]) || text_[at_] == '(')) return {};
    const std::string product = std::string(text_.substr(0, at_)) + "*" + std::string(text_.substr(at_));
    return "; a product is written " + quoted(std::string_view(product));
  }

  NodePtr make(Kind kind, NodePtr left = nullptr, NodePtr right = nullptr, std::string text = {}) {
    if (++nodes_ > max_nodes) fail("comes after too many operations");
    return std::make_shared<const Node>(Node{kind, std::move(text), std::move(left), std::move(right)});
  }

  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
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
      if (accept('+'))
        left = make(Kind::add, left, product());
      else if (accept('-'))
        left = make(Kind::subtract, left, product());
      else
        break;
    }
    --depth_;
    return left;
  }

  NodePtr product() {
    NodePtr left = signed_power();
    for (;;) {
      if (accept('*'))
        left = make(Kind::multiply, left, signed_power());
      else if (accept('/'))
        left = make(Kind::divide, left, signed_power());
      else
        return left;
    }
  }

  NodePtr signed_power() {
    bool negative = false;
    for (;;) {
      if (accept('-'))
        negative = !negative;
      else if (!accept('+'))
        break;
    }
    const NodePtr value = power();
    return negative ? make(Kind::negate, value) : value;
  }

  NodePtr power() {
    if (++depth_ > max_depth) fail("is nested too deeply");
    NodePtr base = primary();
    if (accept('^')) base = make(Kind::power, base, signed_power());
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
    return make(Kind::decimal, nullptr, nullptr, std::string(text_.substr(start, at_ - start)));
  }

  NodePtr name() {
    const std::size_t start = at_;
    while (at_ < text_.size() && (is_name_start(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string word(text_.substr(start, at_ - start));
    for (const auto& [function, kind] : functions) {
      if (word != function) continue;
      if (!accept('(')) fail("comes where '(' is expected after " + word);
      const NodePtr argument = sum();
      close();
      return make(kind, argument);
    }
    if (word == "pi") return make(Kind::pi);
    return make(Kind::name, nullptr, nullptr, word);
  }

  std::string_view text_;
  std::size_t at_ = 0, nodes_ = 0;
  int depth_ = 0;
};

void collect_names(const Node& node, std::set<std::string>& names) {
  if (node.kind == Kind::name) names.insert(node.text);
  if (node.left) collect_names(*node.left, names);
  if (node.right) collect_names(*node.right, names);
}

}  // namespace

Expression Expression::parse(std::string_view text) { return {std::string(text), Parser(text).parse()}; }

std::set<std::string> Expression::names() const {
  std::set<std::string> names;
  collect_names(*root_, names);
  return names;
}

}  // namespace hbvm
