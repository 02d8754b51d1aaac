// Shared by the parts of the audit: the outlines of the bodies, their names, and which edges are in a contact pair.
#pragma once

#include "contact/outline.hpp"
#include "problem/contact_pair.hpp"

namespace mortise {

struct AuditedBodies {
  /// A curve that a contact pair sets against another, and that one's body.
  struct Partner {
    int boundary, body;
  };

  const Mesh& mesh;
  std::vector<std::vector<Partner>> partners;  ///< of each boundary
  std::vector<std::vector<int>> cells;         ///< of each piece
  BoundaryEdges boundary;
  Outline outline;                      ///< undeformed
  std::vector<std::vector<int>> names;  ///< boundaries of each edge of the outline
};

/// Throws InputError where elements are listed twice.
AuditedBodies audited_bodies(const Mesh& mesh, const std::vector<ContactPair>& pairs);

/// True if a contact pair stands between two edges of the outlines.
bool paired(const AuditedBodies& bodies, int edge, int other);

/// The same for each of them or an edge beside it: a pair's curves and one edge more at their ends.
bool nearly_paired(const AuditedBodies& bodies, int edge, int other);

/// True if a pair stands between an edge and any curve of a body.
bool paired_with_body(const AuditedBodies& bodies, int edge, int body);

/// Two places of outlines that face each other: the normal there, and what is nearest.
bool face_each_other(const Vec2& normal, const OutlinePlace& place);

/// "bodies 'a' and 'b'", or "two pieces of body 'a'".
std::string two_bodies(const Mesh& mesh, int first, int second);

/// The boundary that holds most of the edges' length, or -1 for none: of equals the one with fewer edges in all.
int main_name(const AuditedBodies& bodies, const std::vector<int>& edges);

/// The name that covers most of the edges' length, quoted; "an unnamed boundary of 'body'" where no name covers a
/// third.
std::string name_of(const AuditedBodies& bodies, const std::vector<int>& edges);

/// Advice that adds the contact: [[contact]] between the two names, if each is of one body; of two pieces of one body,
/// to join them.
std::string advice(const AuditedBodies& bodies, const std::vector<int>& edges, const std::vector<int>& others);

/// The edge whose middle is nearest to the middle of all: where to look. Its middle.
Vec2 middle_of(const AuditedBodies& bodies, const std::vector<int>& edges);

}  // namespace mortise
