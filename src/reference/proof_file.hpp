#pragma once

#include <string>
#include <vector>

#include "reference/proof/proved_step.hpp"
#include "reference/store.hpp"

namespace hbvm::core {

/// What proves a reference, so that each step can be checked by itself.
struct KeptProof {
  std::string scene;    ///< its file's text
  unsigned digits = 0;  ///< of the centres
  std::vector<ProvedStep> steps;
};

/// A proof and what it proves.
struct ProofFile {
  KeptProof proof;
  StoredReference claim;
};

/// TOML: a checksum of what follows it, the scene, the reference, and each step. Its numbers are exact, see hex_text().
/// The order of a step is by how many coefficients its forces are balanced. Its polynomials are in units of time
/// `unit`. `before`, `tube` and `after` are distances of the exact motion, each with the rate by which it is measured.
std::string to_text(const ProofFile& file);

/// What such a text says; `name` is for messages.
/// \throws InputError where it is none, or was changed
ProofFile read_proof(const std::string& text, const std::string& name);

}  // namespace hbvm::core
