# Fails unless README holds the text of EXAMPLE, word for word.
file(READ "${README}" readme)
file(READ "${EXAMPLE}" example)
string(FIND "${readme}" "${example}" place)
if(place LESS 0)
  message(FATAL_ERROR "${README} does not show ${EXAMPLE} as it is")
endif()
