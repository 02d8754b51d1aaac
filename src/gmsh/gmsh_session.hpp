// gmsh, started and always ended, with one file open. No gmsh header here.
#pragma once

#include <functional>
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

  /// Opens a .msh, or a .geo with these values for its DefineConstant names, unmeshed unless the .geo meshes itself.
  /// Throws InputError with gmsh's own message. A LibraryGuard should be there, here and below.
  void read(const std::string& file, const std::map<std::string, double>& parameters);

  /// Opens the text of a .geo, which messages tell as `file`. Throws as read does.
  void read_text(const std::string& file, const std::string& text);

  /// All options as they were before a file was read.
  void reset_options();

  /// Reads, and meshes the surfaces unless the .geo has done so itself. Throws as read does.
  void open(const std::string& file, const std::map<std::string, double>& parameters);

  /// Runs a step of gmsh; whatever it throws (gmsh 4.8: strings and numbers too) or only logs becomes an InputError of
  /// `file` that says `what` it did.
  void run(const std::string& file, const std::string& what, const std::function<void()>& step);

 private:
  int omp_threads_;
  std::string locale_;
};

}  // namespace mortise
