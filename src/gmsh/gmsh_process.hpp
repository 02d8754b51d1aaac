// gmsh in a child process: what it does to its process, crashes and programs that a .geo runs among it, is not done
// here.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "gmsh/gmsh_module.hpp"
#include "model/geo_limits.hpp"

namespace mortise {

/// The module's functions on one .geo, a child process a call, in a sandbox: the mesh of a .geo that reaches for
/// nothing beyond it depends on the files that it reads, alone. Where the sandbox stops it, it is run again outside of
/// one if `limits` let it run programs, from then on each time.
///
/// All throw InputError as the module does, where gmsh crashes, ends or takes too long (run_in_child), and where the
/// .geo may not run programs and does.
class GmshProcess {
 public:
  GmshProcess(std::string file, const GeoLimits& limits) : file_(std::move(file)), limits_(limits) {}

  MeshData mesh_geo(const std::map<std::string, double>& parameters);
  FreeDrawing read_drawing(const std::map<std::string, double>& parameters);
  /// `seconds`: time limit.
  MeshData mesh_freely(const FreeGeometry& geometry, const SizeAt& size, bool recombine, double seconds);

  /// Whether a call so far was stopped by the sandbox.
  bool acts() const { return acts_; }

 private:
  std::string run(const std::function<std::string(ForbiddenBy)>& work, double seconds);

  std::string file_;
  GeoLimits limits_;
  bool acts_ = false;
};

}  // namespace mortise
