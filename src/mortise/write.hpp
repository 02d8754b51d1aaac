/// Results and meshes into files: write_results, write_msh.
#pragma once

#include "gmsh/write_msh.hpp"
#include "results/write_results.hpp"
