// mesh_to_glb IN OUT: a mesh of research as a glTF that `lozenge` reads; or as an OFF, which is what other programs
// read.
#include <CLI/CLI.hpp>

#include "tools/bench/bench_program.h"
#include "tools/bench/mesh_file.h"

int main(int argc, char** argv) {
  CLI::App app("Converts an .off, .obj, .ply or .stl to a GLB of one mesh, or any mesh, a .glb too, to an .off",
               "mesh_to_glb");
  std::string input;
  std::string output;
  app.add_option("input", input, "An .off, .obj, .ply, .stl, .glb or .gltf")->required()->type_name("");
  app.add_option("output", output, "A .glb, or an .off")->required()->type_name("");
  return lozenge::bench::run_bench_program(
      app, argc, argv, [&] { lozenge::bench::write_mesh(output, lozenge::bench::read_mesh(input)); });
}
