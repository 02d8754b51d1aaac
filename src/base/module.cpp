#include "base/module.hpp"

#include <dlfcn.h>

#include "base/errors.hpp"

namespace mortise {

const void* load_functions(const std::string& name, const std::string& use) {
  // Never closed: gmsh registers functions to be called at the end of the process.
  void* const library = ::dlopen((name + ".so").c_str(), RTLD_NOW | RTLD_LOCAL);
  const void* const functions = library ? ::dlsym(library, name.c_str()) : nullptr;
  if (!functions) throw InputError(use + ", which cannot be loaded: " + ::dlerror());
  return functions;
}

}  // namespace mortise
