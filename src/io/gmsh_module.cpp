#include "io/gmsh_module.hpp"

#include <dlfcn.h>

#include "base/errors.hpp"

namespace mortise {
namespace {

const GmshModule& load() {
  // Never closed: gmsh registers functions to be called at the end of the process.
  void* const library = ::dlopen("mortise_gmsh.so", RTLD_NOW | RTLD_LOCAL);
  const void* const functions = library ? ::dlsym(library, "mortise_gmsh") : nullptr;
  if (!functions) throw InputError(std::string("a .geo is meshed by gmsh, which cannot be loaded: ") + ::dlerror());
  return *static_cast<const GmshModule*>(functions);
}

}  // namespace

const GmshModule& gmsh_module() {
  static const GmshModule& module = load();
  return module;
}

}  // namespace mortise
