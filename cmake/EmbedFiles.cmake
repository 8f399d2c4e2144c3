# slambench_embed_files(TARGET HEADER NAME FILE [NAME FILE]...): puts files into the library, byte by
# byte, by the assembler. The generated header FOLDER/HEADER.h has for each a function
# HEADER::NAME() of type std::string_view; one whose FILE is "" is empty.
enable_language(ASM)

function(slambench_embed_files target header)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/generated")
  get_filename_component(space "${header}" NAME_WE)
  set(prefix "slambench_${space}")
  set(assembly ".section .rodata\n")
  set(declarations "")
  set(functions "")
  set(rows "")
  set(files "")
  set(arguments "${ARGN}")
  while(arguments)
    list(POP_FRONT arguments name file)
    set(begin "${prefix}_${name}_begin")
    set(end "${prefix}_${name}_end")
    string(APPEND assembly ".global ${begin}\n${begin}:\n")
    if(file)
      string(APPEND assembly ".incbin \"${file}\"\n")
      list(APPEND files "${file}")
    endif()
    string(APPEND assembly ".global ${end}\n${end}:\n.byte 0\n")
    string(APPEND declarations "extern const char ${begin}[];\nextern const char ${end}[];\n")
    string(APPEND functions "inline std::string_view ${name}() {\n"
           "  return {${begin}, static_cast<std::size_t>(${end} - ${begin})};\n}\n")
    string(APPEND rows "  if (name == \"${name}\") return ${name}();\n")
  endwhile()
  # An object without this note makes the linker ask for an executable stack.
  string(APPEND assembly ".section .note.GNU-stack,\"\",%progbits\n")

  string(REPLACE "/" "_" source "${header}")
  set(source "${folder}/${source}.s")
  file(CONFIGURE OUTPUT "${source}" CONTENT "${assembly}" @ONLY)
  file(CONFIGURE OUTPUT "${folder}/${header}" @ONLY CONTENT
"#pragma once
#include <cstddef>
#include <string_view>

namespace slambench::${space} {
extern \"C\" {
${declarations}}

${functions}
inline std::string_view find(std::string_view name) {
${rows}  return {};
}

}  // namespace slambench::${space}
")
  set_source_files_properties("${source}" PROPERTIES LANGUAGE ASM OBJECT_DEPENDS "${files}")
  target_sources(${target} PRIVATE "${source}")
  target_include_directories(${target} PUBLIC "${folder}")
endfunction()
