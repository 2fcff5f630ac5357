# Writes OUTPUT, a C++ file with the parts of page_parts.hpp: those of FOLDER, and dygraphs from LIBRARY, which may be empty.
set(parts "")

include(${CMAKE_CURRENT_LIST_DIR}/../../text_literal.cmake)

# The text of files, one after another
function(embed)
  set(text "")
  foreach(file ${ARGN})
    file(READ ${file} content)
    # What a debugger would look for on the net
    string(REGEX REPLACE "/[/*]# sourceMappingURL=[^\n]*" "" content "${content}")
    string(APPEND text "${content}")
  endforeach()
  text_literal(literal "${text}")
  set(parts "${parts}      ${literal},\n" PARENT_SCOPE)
endfunction()

embed(${FOLDER}/page.html)
embed(${FOLDER}/page.css)
embed(${FOLDER}/numbers.js ${FOLDER}/theme.js ${FOLDER}/motion.js ${FOLDER}/stage.js ${FOLDER}/chart.js
      ${FOLDER}/player.js)
if(LIBRARY)
  set(dygraphs_style ${LIBRARY}/dygraph.min.css)
  set(dygraphs ${FOLDER}/dygraphs_licence.js ${LIBRARY}/dygraph.min.js)
endif()
embed(${dygraphs_style})
embed(${dygraphs})
file(WRITE ${OUTPUT}
     "// Made by src/run/page/embed.cmake.\n#include \"run/page_parts.hpp\"\n\n"
     "const hbvm::core::PageParts& hbvm::core::page_parts() {\n  static const PageParts parts{\n${parts}  };\n  return parts;\n}\n")
