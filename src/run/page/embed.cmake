# Writes OUTPUT, a C++ file with the parts of page_parts.hpp: those of FOLDER, and dygraphs from LIBRARY, which may be empty.
set(parts "")

# The text of files as literals that every compiler takes: of less than 65536 bytes, cut behind a semicolon.
function(embed)
  set(text "")
  foreach(file ${ARGN})
    file(READ ${file} content)
    # What a debugger would look for on the net
    string(REGEX REPLACE "/[/*]# sourceMappingURL=[^\n]*" "" content "${content}")
    string(APPEND text "${content}")
  endforeach()
  set(literals "")
  string(LENGTH "${text}" length)
  while(length GREATER 60000)
    string(SUBSTRING "${text}" 0 60000 head)
    string(FIND "${head}" ";" cut REVERSE)
    math(EXPR cut "${cut} + 1")
    string(SUBSTRING "${text}" 0 ${cut} head)
    string(SUBSTRING "${text}" ${cut} -1 text)
    string(APPEND literals "std::string(R\"page(${head})page\") + ")
    string(LENGTH "${text}" length)
  endwhile()
  set(parts "${parts}      ${literals}std::string(R\"page(${text})page\"),\n" PARENT_SCOPE)
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
