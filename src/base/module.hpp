// Shared objects that are loaded when they are needed: a table of functions each, of the shared object's own name.
#pragma once

#include <string>

namespace mortise {

/// From where the program's RPATH says; never closed. `use` ("a .geo is meshed by gmsh") begins the message of the
/// InputError that is thrown, with the loader's words, where it or a library that it needs is not there.
const void* load_functions(const std::string& name, const std::string& use);

template <class Functions>
const Functions& load_module(const std::string& name, const std::string& use) {
  return *static_cast<const Functions*>(load_functions(name, use));
}

}  // namespace mortise
