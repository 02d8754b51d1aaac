#include "problem/dirichlet_neumann.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

// Two bodies with a contact pair or common nodes between them.
struct Link {
  int body, other;
  bool differ;                             // in contact: different roles
  bool body_finer;                         // in contact: its edges are the shorter ones, or as long
  bool body_prescribed, other_prescribed;  // in contact: its curve's normal displacements are all given
  std::string key;
};

bool prescribed(const Mesh& mesh, const Curve& curve, const Constraints& constraints) {
  for (const Edge& edge : curve.edges)
    for (int a = 0; a < edge.node_count; ++a) {
      const Vec2 n = edge_point(mesh.nodes, edge, xi_of_node(a)).normal();
      if (!prescribed_along(constraints, edge.nodes[a], n)) return false;
    }
  return true;
}

std::vector<Link> contact_links(const Mesh& mesh, const std::vector<ContactCurves>& contacts,
                                const Constraints& constraints) {
  std::vector<Link> links;
  for (const ContactCurves& contact : contacts)
    links.push_back({.body = contact.curves[0].body,
                     .other = contact.curves[1].body,
                     .differ = true,
                     .body_finer = contact.edge_size[0] <= (1 + 1e-6) * contact.edge_size[1],
                     .body_prescribed = prescribed(mesh, contact.curves[0], constraints),
                     .other_prescribed = prescribed(mesh, contact.curves[1], constraints),
                     .key = contact.spec.key});
  return links;
}

void add_shared_nodes(const Mesh& mesh, std::vector<Link>& links) {
  std::vector<int> owner(mesh.nodes.rows(), -1);
  for (const Cell& cell : mesh.cells)
    for (int a = 0; a < node_count(cell.kind); ++a) {
      int& first = owner[cell.nodes[a]];
      if (first < 0) first = cell.body;
      if (first != cell.body) links.push_back({first, cell.body, false, false, false, false, "common nodes"});
    }
}

// Bodies that hang together are a set, dealt out in two sides, 0 and 1; -1 for bodies that contact does not reach.
struct Dealt {
  std::vector<int> set, side;  // of each body
  int sets = 0;
};

[[noreturn]] void fail_in_turns(const Mesh& mesh, const Link& link) {
  throw SceneError(link.key + ": '" + mesh.bodies[link.body] + "' and '" + mesh.bodies[link.other] +
                   "' cannot take the displacement in turns: domain decomposition needs bodies in a chain, "
                   "each in contact with others of the opposite role only; expected method.solver = \"direct\"");
}

// From the first body of each contact on along the links.
Dealt deal_out(const Mesh& mesh, const std::vector<Link>& links, std::size_t contacts) {
  const std::size_t bodies = mesh.bodies.size();
  std::vector<std::vector<const Link*>> links_of(bodies);
  for (const Link& link : links)
    for (const int body : {link.body, link.other}) links_of[body].push_back(&link);
  Dealt dealt{std::vector<int>(bodies, -1), std::vector<int>(bodies, -1)};
  for (std::size_t k = 0; k < contacts; ++k) {
    if (dealt.set[links[k].body] >= 0) continue;
    std::vector<int> reached{links[k].body};
    dealt.set[reached[0]] = dealt.sets;
    dealt.side[reached[0]] = 0;
    for (std::size_t i = 0; i < reached.size(); ++i)
      for (const Link* link : links_of[reached[i]]) {
        const int body = reached[i], other = link->body == body ? link->other : link->body;
        const int side = link->differ ? 1 - dealt.side[body] : dealt.side[body];
        if (dealt.set[other] < 0) {
          dealt.set[other] = dealt.sets;
          dealt.side[other] = side;
          reached.push_back(other);
        }
        if (dealt.side[other] != side) fail_in_turns(mesh, *link);
      }
    ++dealt.sets;
  }
  return dealt;
}

// Of each set the side whose bodies take the displacement by their `names`; -1 if none does.
std::vector<int> named_sides(const std::vector<std::string>& names, const Mesh& mesh, const Dealt& dealt) {
  std::vector<int> named(dealt.sets, -1);
  for (const std::string& name : names) {
    const int body = body_index(mesh, name), set = dealt.set[body];
    if (set < 0) continue;
    if (named[set] >= 0 && dealt.side[body] != named[set])
      throw SceneError("method.dirichlet: '" + name + "' is in contact with a body of the same role");
    named[set] = dealt.side[body];
  }
  return named;
}

// Of each set the side with the softer bodies; of equally stiff ones that with the finer curves. A body whose whole
// curve is prescribed cannot take the displacement.
std::vector<int> softer_sides(const std::vector<Link>& links, const Dealt& dealt, const std::vector<ElasticLaw>& laws) {
  struct Sides {
    std::array<double, 2> stiffest{};
    std::array<int, 2> finer{}, given{};
  };
  std::vector<Sides> sets(dealt.sets);
  for (std::size_t b = 0; b < laws.size(); ++b) {
    if (dealt.set[b] < 0) continue;
    double& stiffest = sets[dealt.set[b]].stiffest[dealt.side[b]];
    stiffest = std::max(stiffest, laws[b].young);
  }
  for (const Link& link : links) {
    if (!link.differ) continue;
    Sides& set = sets[dealt.set[link.body]];
    const int body = dealt.side[link.body], other = 1 - body;
    ++set.finer[link.body_finer ? body : other];
    set.given[body] += link.body_prescribed;
    set.given[other] += link.other_prescribed;
  }
  std::vector<int> softer;
  for (const auto& [stiffest, finer, given] : sets)
    softer.push_back(given[0] != given[1]         ? given[1] < given[0]
                     : stiffest[0] != stiffest[1] ? stiffest[1] < stiffest[0]
                                                  : finer[1] > finer[0]);
  return softer;
}

}  // namespace

std::vector<char> dirichlet_bodies(const std::vector<std::string>& names, const Mesh& mesh, const Discretisation& d,
                                   const std::vector<ContactCurves>& contacts) {
  std::vector<Link> links = contact_links(mesh, contacts, d.system.constraints);
  add_shared_nodes(mesh, links);
  for (const Tie& tie : mesh.ties)
    if (tie.body[0] != tie.body[1]) links.push_back({tie.body[0], tie.body[1], false, false, false, false, tie.key});
  const Dealt dealt = deal_out(mesh, links, contacts.size());
  const std::vector<int> named = named_sides(names, mesh, dealt), softer = softer_sides(links, dealt, d.laws);
  std::vector<char> dirichlet(mesh.bodies.size(), 0);
  for (std::size_t b = 0; b < dirichlet.size(); ++b) {
    const int set = dealt.set[b];
    if (set >= 0) dirichlet[b] = dealt.side[b] == (named[set] >= 0 ? named[set] : softer[set]);
  }
  return dirichlet;
}

std::vector<std::string> dirichlet_names(const Mesh& mesh, const std::vector<char>& dirichlet) {
  std::vector<std::string> names;
  for (std::size_t b = 0; b < dirichlet.size(); ++b)
    if (dirichlet[b]) names.push_back(mesh.bodies[b]);
  return names;
}

std::vector<char> unknowns_of(const Mesh& mesh, const std::vector<char>& bodies) {
  if (bodies.empty()) return {};
  std::vector<char> member(2 * mesh.nodes.rows(), 0);
  for (const Cell& cell : mesh.cells)
    for (int a = 0; a < node_count(cell.kind); ++a)
      member[2 * cell.nodes[a]] = member[2 * cell.nodes[a] + 1] = bodies[cell.body];
  return member;
}

}  // namespace mortise
