// A value of a scene file, and where it was written.
#pragma once

#include <string>
#include <vector>

/// How a scene file is read; the rest of the program needs scene.hpp only.
namespace mortise::scene_file {

/// The place at which a value was written: in a line of the scene file, or in an override given on the command line.
struct Place {
  std::string file;     ///< the scene file
  int line = 0;         ///< from 1; 0 for the document itself and for overrides
  int column = 0;       ///< from 1; 0: unknown
  std::string setting;  ///< "--set KEY=VALUE"; empty for what the file says
};

/// One value of the document. Tables keep their entries in the order of the file; overrides come last.
struct Node {
  enum class Kind { table, list, string, number, boolean, date };

  Kind kind = Kind::table;
  std::string name;         ///< its key in a table or index in a list
  std::string path;         ///< the dotted keys that lead to it, e.g. "contact.0.condition"; empty for the document
  Place place;              ///< where it was written
  double number = 0;        ///< of a number; integers are numbers
  int column = 0;           ///< from 1, where a string's first character stands in the line; 0: not known
  std::string text;         ///< of a string; of the other scalars the value in words, for messages
  std::vector<Node> items;  ///< of a table or a list
};

}  // namespace mortise::scene_file
