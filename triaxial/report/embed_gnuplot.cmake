# The .gnuplot files below a folder become part of a library: grainfield_embed_gnuplot() makes a
# source file that defines `function` (see gnuplot_template.hpp), anew when one of them changes.

if(CMAKE_SCRIPT_MODE_FILE)
  set(entries "")
  foreach(file ${FILES})
    get_filename_component(name ${file} NAME_WE)
    file(READ ${file} text)
    string(APPEND entries "        {\"${name}\", R\"gnuplot(${text})gnuplot\"},\n")
  endforeach()
  file(WRITE ${OUT} "#include \"triaxial/report/gnuplot_template.hpp\"\n
namespace ${NAMESPACE} {\n
std::span<const triaxial::report::GnuplotTemplate> gnuplot_templates() {
    static constexpr triaxial::report::GnuplotTemplate all[] = {\n${entries}    };
    return all;\n}\n\n}  // namespace ${NAMESPACE}\n")
  return()
endif()

set(grainfield_embed_gnuplot_script ${CMAKE_CURRENT_LIST_FILE})
function(grainfield_embed_gnuplot target folder namespace)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.gnuplot)
  set(made ${CMAKE_BINARY_DIR}/gnuplot/${target}.cpp)
  add_custom_command(OUTPUT ${made} VERBATIM
      DEPENDS ${files} ${grainfield_embed_gnuplot_script}
      COMMAND ${CMAKE_COMMAND} "-DFILES=${files}" -DOUT=${made} -DNAMESPACE=${namespace}
              -P ${grainfield_embed_gnuplot_script})
  target_sources(${target} PRIVATE ${made})
endfunction()
