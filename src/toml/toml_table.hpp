#pragma once

#include <toml++/toml.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scalar/expression.hpp"

namespace hbvm::core {

/// The text of a TOML file, to read decimals from it exactly, and its name for messages.
class TomlSource {
 public:
  /// \param top_keys those of the file itself, which messages point out where they stand inside a table instead
  TomlSource(std::string text, std::string name, std::set<std::string, std::less<>> top_keys = {});

  const std::string& name() const { return name_; }
  bool is_top_key(std::string_view key) const { return top_keys_.contains(key); }
  /// Without the byte order mark that it may have begun with.
  const std::string& text() const { return text_; }
  toml::table parse() const;
  [[noreturn]] void fail(std::size_t line, const std::string& what) const;
  /// Where in the text a place is; its end if it is none.
  std::size_t offset_of(const toml::source_position& place) const;
  /// Line and column, from 1, of the first character of a string that the text has literally between two places. Column
  /// 0 if it is written with escapes.
  toml::source_position begin_of(std::string_view string, const toml::source_region& region) const;
  /// The characters of a number that stands at this place.
  std::string number_at(const toml::source_position& begin) const;

 private:
  std::string text_, name_;
  std::set<std::string, std::less<>> top_keys_;
  std::vector<std::size_t> line_starts_;
};

/// One table of a TOML file. Each reading takes a key; finish() refuses the keys nobody took.
class TomlTable {
 public:
  /// \param what names the table in messages: "body 'a'"
  TomlTable(const TomlSource& source, const toml::table& table, std::string what);

  const TomlSource& source() const { return source_; }
  std::size_t line() const { return line_; }
  const std::string& what() const { return what_; }
  void rename(std::string what) { what_ = std::move(what); }
  [[noreturn]] void fail(const std::string& what) const { source_.fail(line_, what_ + ": " + what); }
  [[noreturn]] void fail(const toml::node& node, const std::string& what) const;

  bool has(std::string_view key) const { return table_.contains(key); }
  const toml::node* take(std::string_view key);
  const toml::node& require(std::string_view key);
  /// Refuses the table because one of these keys should be there.
  [[noreturn]] void missing(const std::vector<std::string>& keys) const;
  /// Refuses a key of the file itself that stands here, since what follows a header belongs to its table.
  [[noreturn]] void misplaced(std::string_view key, const toml::node& node) const;
  /// Refuses keys that are not among these.
  void expect(const std::vector<std::string>& keys);

  std::string string(std::string_view key);
  std::string optional_string(std::string_view key);
  long integer(std::string_view key);
  bool is_array(std::string_view key) const;
  Expression number(std::string_view key);
  std::optional<Expression> optional_number(std::string_view key);
  std::vector<Expression> vector(std::string_view key, std::size_t size);
  std::vector<std::vector<Expression>> matrix(std::string_view key, std::size_t size);
  std::vector<std::string> strings(std::string_view key);
  /// The tables of an array of tables [[key]]; none if it is absent.
  std::vector<const toml::table*> tables(std::string_view key);

  Expression to_number(const toml::node& node, const std::string& where) const;
  std::vector<Expression> to_vector(const toml::node& node, std::size_t size, const std::string& where) const;
  std::string to_string(const toml::node& node, const std::string& where) const;

  /// \throws InputError naming the first unknown key and the nearest known one, or all
  void finish() const;

 private:
  const TomlSource& source_;
  const toml::table& table_;
  std::string what_;
  std::size_t line_;
  std::set<std::string, std::less<>> known_;
};

}  // namespace hbvm::core
