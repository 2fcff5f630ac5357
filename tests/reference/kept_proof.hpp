#pragma once

#include <string>
#include <vector>

#include "checksum.hpp"
#include "reference/proof_file.hpp"
#include "reference/request_of.hpp"

namespace hbvm::core {

/// A proof of 12 digits.
inline ProofFile proof_of(const char* scene, const std::vector<const char*>& times = {"1/2", "2"}) {
  ProofFile file;
  ReferenceRequest request = request_of(scene, times, 12);
  request.prove = true;
  request.proof = &file.proof;
  file.claim = {compute_reference(request), "1", "2026-01-01"};
  return file;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

/// The text with the checksum that it should have.
inline std::string with_checksum(const std::string& text) {
  const std::size_t body = text.find('\n', text.find("checksum")) + 1;
  const std::string sum = Checksum(std::string_view(text).substr(body)).text();
  return text.substr(0, body - sum.size() - 2) + sum + "\"\n" + text.substr(body);
}

}  // namespace hbvm::core
