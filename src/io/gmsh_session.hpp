// gmsh, started and always ended, with one file open. No gmsh header here.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace mortise {

/// One at a time in a process: gmsh keeps its model in global variables.
class GmshSession {
 public:
  /// Starts gmsh: silent, one thread, no configuration files of the user's.
  GmshSession();
  /// Ends gmsh and puts back what it changes in the process: OpenMP's number of threads and the locale.
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  /// Opens a .msh, or a .geo with these values for its DefineConstant names, and meshes its surfaces unless the .geo
  /// has done so itself. Throws InputError with gmsh's own message. A GmshGuard should be there.
  void open(const std::string& file, const std::map<std::string, double>& parameters);

  /// Writes the open mesh as .msh, format 4.1. Throws InputError with gmsh's own message.
  void write(const std::string& output);

 private:
  int omp_threads_;
  std::string locale_;
};

}  // namespace mortise
