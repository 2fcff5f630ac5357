#pragma once

#include "scene/scene_text.hpp"

namespace hbvm::core {

/// Tables of a scene. Their values are written as in TOML: "[0, \"1/3\"]". `more` holds further lines.

inline std::string point(const std::string& name, const std::string& position, const std::string& more = "") {
  return "[[point]]\nname = \"" + name + "\"\nposition = " + position + "\n" + more;
}

inline std::string body(const std::string& name, const std::string& mass, const std::string& position,
                        const std::string& velocity, const std::string& more = "") {
  return "[[body]]\nname = \"" + name + "\"\nmass = " + mass + "\nposition = " + position + "\nvelocity = " + velocity +
         "\n" + more;
}

/// \param keys lines, of which the last may want its end
inline std::string effect(const std::string& kind, const std::string& keys) {
  return "[[effect]]\nkind = \"" + kind + "\"\n" + keys + "\n";
}

inline std::string field(const std::string& acceleration) {
  return effect("uniform_gravity", "acceleration = " + acceleration);
}

inline std::string formula(const std::string& U) { return effect("formula", "U = \"" + U + "\""); }

inline std::string plane(const std::string& body, const std::string& normal, const std::string& offset) {
  return "[[constraint]]\nkind = \"plane\"\nbody = \"" + body + "\"\nnormal = " + normal + "\noffset = " + offset +
         "\n";
}

inline std::string quadric(const std::string& body, const std::string& A, const std::string& b, const std::string& c) {
  return "[[constraint]]\nkind = \"quadric\"\nbody = \"" + body + "\"\nA = " + A + "\nb = " + b + "\nc = " + c + "\n";
}

}  // namespace hbvm::core
