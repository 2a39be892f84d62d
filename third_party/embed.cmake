# lb_embed(<name> <header> <symbol> <file> [<symbol> <file>]...): files as bytes in the program, so that it
# runs from anywhere. lb::<name> gives <header>, which declares for each
#   extern const unsigned char <symbol>[]; extern const std::size_t <symbol>_size;
function(lb_embed name header)
  set(directory ${CMAKE_CURRENT_BINARY_DIR}/${name})
  set(declarations "#pragma once\n// Files as bytes; sizes in bytes.\n\n#include <cstddef>\n\n")
  string(APPEND declarations "extern \"C\" {\n")
  set(assembly ".section .rodata\n")
  set(files "")
  while(ARGN)
    list(POP_FRONT ARGN symbol file)
    list(APPEND files ${file})
    string(APPEND declarations
      "extern const unsigned char ${symbol}[];\nextern const std::size_t ${symbol}_size;\n")
    string(APPEND assembly
      ".global ${symbol}, ${symbol}_size\n.balign 16\n${symbol}: .incbin \"${file}\"\n"
      "1:\n.balign 8\n${symbol}_size: .quad 1b - ${symbol}\n")
  endwhile()
  string(APPEND declarations "}\n")
  string(APPEND assembly ".section .note.GNU-stack,\"\",@progbits\n")
  file(CONFIGURE OUTPUT ${directory}/${header} CONTENT "${declarations}" @ONLY)
  file(CONFIGURE OUTPUT ${directory}/${name}.S CONTENT "${assembly}" @ONLY)
  add_library(lb_${name} STATIC ${directory}/${name}.S)
  add_library(lb::${name} ALIAS lb_${name})
  set_property(SOURCE ${directory}/${name}.S PROPERTY OBJECT_DEPENDS "${files}")
  target_include_directories(lb_${name} SYSTEM PUBLIC ${directory})
endfunction()
