#pragma once

#include <string>

namespace hbvm::core {

/// A drawing as part of an HTML page: its outermost element without what draws nothing. Nothing of it can act or ask
/// the network. Only elements that draw are kept, no scripts, styles, pictures or links. References are kept only to
/// what is in it.
struct InlineSvg {
  std::string svg;
  std::string data;  ///< the JSON of figure_data, or nothing
};

/// \param prefix of its ids, so that several drawings are told apart on a page \param file its name, for messages
/// \throws InputError with file and line if it is no drawing
InlineSvg inline_svg(const std::string& text, const std::string& prefix, const std::string& file);

}  // namespace hbvm::core
