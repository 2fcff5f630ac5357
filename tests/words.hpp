#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "hbvm/error.hpp"

namespace hbvm::core {

/// All of these words are in the text.
inline void expect_words(const std::string& text, std::initializer_list<std::string> words) {
  for (const std::string& word : words)
    EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' is not in: " << text;
}

/// What the error says that ends the work; it must end so.
template <class E = InputError, class F>
std::string message_of(const F& work) {
  try {
    work();
  } catch (const E& error) {
    return error.what();
  }
  ADD_FAILURE() << "the work was done";
  return {};
}

}  // namespace hbvm::core
