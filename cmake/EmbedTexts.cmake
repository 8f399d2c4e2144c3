# cmake -DSOURCES=a.cl;b.cl -DOUTPUT=file.cpp -P EmbedTexts.cmake: the texts of files, by their names
# without extension, as the C++ function slambench::kernel_source.
set(rows "")
foreach(source IN LISTS SOURCES)
  get_filename_component(name "${source}" NAME_WE)
  file(READ "${source}" text)
  string(APPEND rows "    {\"${name}\", R\"__cl__(${text})__cl__\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"backends/opencl/kernels/kernel_sources.h\"

namespace slambench {

std::string_view kernel_source(std::string_view name) {
  struct Row {
    std::string_view name, text;
  };
  static constexpr Row rows[] = {
${rows}  };
  for (const Row& row : rows) {
    if (row.name == name) return row.text;
  }
  return {};
}

}  // namespace slambench
")
