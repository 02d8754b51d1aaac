// gmsh, started, with one file open. No gmsh header here.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "gmsh/sandbox.hpp"

namespace mortise {

/// The only one of its process, which ends with it: gmsh keeps its model in global variables, changes the locale and
/// the number of threads, and is not asked to tidy up.
class GmshSession {
 public:
  /// Starts gmsh: one thread, no configuration files of the user's; with `forbidden` in a sandbox.
  explicit GmshSession(ForbiddenBy forbidden);
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  /// Opens a .msh, or a .geo with these values for its DefineConstant names, unmeshed unless the .geo meshes itself;
  /// the curves and surfaces of one without groups are groups (gmsh_groups.hpp).
  /// Throws InputError with gmsh's own message.
  void read(const std::string& file, const std::map<std::string, double>& parameters);

  /// Opens the text of a .geo, which messages call `file`. Throws as read does.
  void read_text(const std::string& file, const std::string& text);

  /// All options as they were before a file was read.
  void reset_options();

  /// Whether what was read has cells: a .msh, or a .geo that meshes itself.
  bool has_cells() const;

  /// Runs a step of gmsh; whatever it throws (gmsh 4.8: strings and numbers too) or only logs becomes an InputError of
  /// `file` that says `what` it did.
  void run(const std::string& file, const std::string& what, const std::function<void()>& step);
};

}  // namespace mortise
