#include "gmsh/gmsh_process.hpp"

#include "base/child_process.hpp"
#include "mesh_files/packed_mesh.hpp"

namespace mortise {
namespace {

std::string packed(const FreeDrawing& drawing) {
  const FreeGeometry& geometry = drawing.geometry;
  Packed to;
  to.put(geometry.text);
  put_groups(to, geometry.groups);
  to.put(geometry.shift.data(), 2);
  to.put(std::ssize(drawing.curves));
  for (const DrawnCurve& curve : drawing.curves) {
    to.put(std::ssize(curve.names));
    for (const std::string& name : curve.names) to.put(name);
    Points places(std::ssize(curve.places), 2);
    for (Eigen::Index i = 0; i < places.rows(); ++i) places.row(i) = curve.places[i].transpose();
    to.put(places.data(), std::size_t(places.size()));
  }
  return std::move(to.bytes);
}

FreeDrawing unpacked_drawing(const std::string& bytes) {
  Unpacked from(bytes);
  FreeDrawing drawing;
  FreeGeometry& geometry = drawing.geometry;
  geometry.text = from.text();
  geometry.groups = take_groups(from);
  geometry.shift = Eigen::Map<const Vec2>(from.list<double>().data());
  for (std::int64_t count = from.number(); count > 0; --count) {
    DrawnCurve& curve = drawing.curves.emplace_back();
    for (std::int64_t names = from.number(); names > 0; --names) curve.names.push_back(from.text());
    const std::vector<double> numbers = from.list<double>();
    const Eigen::Map<const Points> places(numbers.data(), std::ssize(numbers) / 2, 2);
    for (const auto& place : places.rowwise()) curve.places.emplace_back(place.transpose());
  }
  return drawing;
}

}  // namespace

std::string GmshProcess::run(const std::function<std::string(ForbiddenBy)>& work, double seconds) {
  const ChildWork child{.file = file_, .seconds = seconds};
  if (!acts_) try {
      return run_in_child(child, [&] { return work(end_child_by_forbidden_act); });
    } catch (const ForbiddenAct& act) {
      if (!limits_.programs)
        throw InputError(file_ + ": it " + act.what() + "; --no-programs (mesh.programs = false) forbids that");
      acts_ = true;
    }
  return run_in_child(child, [&] { return work(nullptr); });
}

MeshData GmshProcess::mesh_geo(const std::map<std::string, double>& parameters) {
  const GmshModule& gmsh = gmsh_module();  // loaded once, here
  MeshData data =
      unpacked_mesh(run([&](ForbiddenBy forbidden) { return packed_mesh(gmsh.mesh_geo(file_, parameters, forbidden)); },
                        limits_.seconds));
  data.file = file_;
  return data;
}

FreeDrawing GmshProcess::read_drawing(const std::map<std::string, double>& parameters) {
  const GmshModule& gmsh = gmsh_module();
  FreeDrawing drawing = unpacked_drawing(run(
      [&](ForbiddenBy forbidden) { return packed(gmsh.read_drawing(file_, parameters, forbidden)); }, limits_.seconds));
  drawing.geometry.file = file_;
  drawing.geometry.parameters = parameters;
  return drawing;
}

MeshData GmshProcess::mesh_freely(const FreeGeometry& geometry, const SizeAt& size, bool recombine, double seconds) {
  const GmshModule& gmsh = gmsh_module();
  MeshData data = unpacked_mesh(
      run([&](ForbiddenBy forbidden) { return packed_mesh(gmsh.mesh_freely(geometry, size, recombine, forbidden)); },
          seconds));
  data.file = file_;
  return data;
}

}  // namespace mortise
