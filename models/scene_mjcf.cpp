#include "models/scene_mjcf.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "models/profile.hpp"

namespace touchdown::models {

namespace {

/// The scene of every robot: solver settings, light, sky and materials. This MJCF text follows the
/// robot's own sections and overrides them.
constexpr const char* common_mjcf = R"(
  <option gravity="0 0 -9.81" timestep="0.001" cone="elliptic" impratio="1" integrator="Euler"/>
  <size njmax="500" nconmax="100"/>
  <statistic extent="1" center="0 0 0.5"/>
  <visual>
    <global fovy="34"/>
    <quality shadowsize="2048" offsamples="0" numslices="36" numstacks="4" numquads="2"/>
    <map znear="0.1" zfar="60" shadowclip="1.3" haze="0.35"/>
    <headlight ambient="0.36 0.37 0.40" diffuse="0.16 0.16 0.17" specular="0.05 0.05 0.05"/>
    <rgba haze="0.86 0.89 0.93 1"/>
  </visual>
  <asset>
    <texture name="touchdown_sky" type="skybox" builtin="gradient" rgb1="0.42 0.58 0.80"
             rgb2="0.90 0.92 0.95" width="512" height="3072"/>
    <texture name="touchdown_grid" type="2d" builtin="checker" rgb1="0.72 0.75 0.79"
             rgb2="0.80 0.82 0.85" mark="edge" markrgb="0.90 0.91 0.93" width="512" height="512"/>
    <material name="touchdown_floor" texture="touchdown_grid" texrepeat="2 2" texuniform="true"
              specular="0" shininess="0" reflectance="0"/>
    <material name="touchdown_step" rgba="0.80 0.775 0.72 1" specular="0.05" shininess="0.1"/>
    <material name="touchdown_edge" rgba="0.95 0.62 0.18 1" specular="0.1"/>
  </asset>
  <worldbody>
    <light name="touchdown_sun" directional="true" pos="3 -3 6" dir="-0.5 0.3 -0.86"
           diffuse="0.62 0.60 0.55" specular="0.3 0.3 0.3" ambient="0 0 0" castshadow="true"/>
    <light name="touchdown_fill" directional="true" dir="0.6 0.5 -0.45" diffuse="0.13 0.15 0.19"
           specular="0 0 0" ambient="0 0 0" castshadow="false"/>
  </worldbody>
)";

/// A point of the side view with its surface normal.
struct OutlinePoint {
  double x, z, nx, nz;
};

/// The surface between two points of the outline.
struct OutlineFace {
  OutlinePoint from, to;
};

constexpr int nosing_faces = 10;

void add_segment(const Profile& profile, std::size_t i, std::vector<OutlineFace>& outline) {
  const Profile::Segment& segment = profile.segments()[i];
  const double nx = segment.nx();
  const double nz = segment.nz();
  const Profile::Edge* edge = profile.edge_after(i);
  const double x1 = edge ? edge->tangent_x : segment.x1;
  const double z1 = edge ? segment.z(x1) : segment.z1;
  outline.push_back({{segment.x0, segment.z0, nx, nz}, {x1, z1, nx, nz}});
  if (!edge) return;
  OutlinePoint last = outline.back().to;
  if (edge->radius > 0.0) {
    const double begin = std::atan2(nz, nx);
    for (int k = 1; k <= nosing_faces; ++k) {
      const double angle = begin * (1.0 - static_cast<double>(k) / nosing_faces);
      const bool end = k == nosing_faces;  // exactly on the face, so that vertices coincide
      const OutlinePoint next{end ? edge->x : edge->centre_x + edge->radius * std::cos(angle),
                              edge->centre_z + (end ? 0.0 : edge->radius * std::sin(angle)),
                              std::cos(angle), std::sin(angle)};
      outline.push_back({last, next});
      last = next;
    }
  }
  outline.push_back({{edge->x, last.z, 1.0, 0.0}, {edge->x, edge->bottom, 1.0, 0.0}});
}

class MeshBuilder {
 public:
  explicit MeshBuilder(double width) : y_(0.5 * width) {}

  /// Adds the surface of `face` across the whole width.
  void add_strip(const OutlineFace& face) {
    const auto& [from, to] = face;
    add_quad({vertex(from, -y_), vertex(to, -y_), vertex(to, y_), vertex(from, y_)});
  }

  /// Adds both side walls of a convex column of the side view, as triangle fans about its middle.
  /// `polygon` runs clockwise seen from −y: its inside is on the right.
  void add_walls(const std::vector<std::array<double, 2>>& polygon) {
    double x = 0.0, z = 0.0;
    for (const auto& point : polygon) {
      x += point[0] / static_cast<double>(polygon.size());
      z += point[1] / static_cast<double>(polygon.size());
    }
    for (const double side : {-1.0, 1.0}) {
      const int first = static_cast<int>(mesh_.vertices.size());
      const int count = static_cast<int>(polygon.size());
      mesh_.vertices.push_back({x, side * y_, z, 0.0, side, 0.0});
      for (const auto& [px, pz] : polygon) {
        mesh_.vertices.push_back({px, side * y_, pz, 0.0, side, 0.0});
      }
      for (int k = 0; k < count; ++k) {
        const int a = first + 1 + k;
        const int b = first + 1 + (k + 1) % count;
        if (side > 0) {
          mesh_.faces.push_back({first, a, b});
        } else {
          mesh_.faces.push_back({first, b, a});
        }
      }
    }
  }

  Mesh take() { return std::move(mesh_); }

 private:
  static Mesh::Vertex vertex(const OutlinePoint& point, double y) {
    return {point.x, y, point.z, point.nx, 0.0, point.nz};
  }

  void add_quad(const std::array<Mesh::Vertex, 4>& corners) {
    const int first = static_cast<int>(mesh_.vertices.size());
    mesh_.vertices.insert(mesh_.vertices.end(), corners.begin(), corners.end());
    mesh_.faces.push_back({first, first + 1, first + 2});
    mesh_.faces.push_back({first, first + 2, first + 3});
  }

  double y_;
  Mesh mesh_;
};

/// Closes the surface `outline` (left to right, from floor to floor) into a solid.
Mesh close(const std::vector<OutlineFace>& outline, double width) {
  MeshBuilder builder(width);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto& [from, to] = outline[i];
    builder.add_strip(outline[i]);
    if (from.x == to.x) continue;  // a vertical face: its neighbours' walls reach along it
    builder.add_strip({{to.x, 0.0, 0.0, -1.0}, {from.x, 0.0, 0.0, -1.0}});
    std::vector<std::array<double, 2>> column = {{from.x, 0.0}};
    if (i > 0 && outline[i - 1].from.x == from.x && outline[i - 1].from.z > 0.0 &&
        outline[i - 1].from.z < from.z) {
      column.push_back({from.x, outline[i - 1].from.z});
    }
    if (from.z > 0.0) column.push_back({from.x, from.z});
    if (to.z > 0.0) column.push_back({to.x, to.z});
    if (i + 1 < outline.size() && outline[i + 1].to.x == to.x && outline[i + 1].to.z > 0.0 &&
        outline[i + 1].to.z < to.z) {
      column.push_back({to.x, outline[i + 1].to.z});
    }
    column.push_back({to.x, 0.0});
    builder.add_walls(column);
  }
  return builder.take();
}

/// Distance of a riser behind its nosing (m), so that a wheel meets only the nosing.
constexpr double riser_recess = 1e-3;
/// Height of an edge stripe above its tread (m): enough for the depth test, too small to see.
constexpr double stripe_height = 3e-4;

class Composer {
 public:
  explicit Composer(const Terrain& terrain) : strips_(strips_of(terrain)) {
    // Every attribute is set, so that the robot's defaults do not apply to the terrain. `solref` is
    // the stiffness of a tyre's contact: a time constant (s) and a damping ratio. Peak landing
    // acceleration from 0.25 m: 334, 224, 135 m/s² at 0.005, 0.01, 0.02 s.
    contact_ = fmt::format(
        "contype=\"2\" conaffinity=\"1\" condim=\"3\" priority=\"10\" margin=\"0\" gap=\"0\" "
        "friction=\"{} 0.005 0.0001\" solref=\"0.01 1\" solimp=\"0.9 0.95 0.001 0.5 2\"",
        terrain.friction);
  }

  std::string compose() {
    double reach = 0.0;
    for (const Strip& strip : strips_) {
      const Profile profile(strip);
      if (profile.segments().empty()) continue;
      reach = std::max(reach, std::abs(profile.segments().back().x1));
    }
    // The third size is the spacing of the drawn grid. Without it MuJoCo draws 40,000 quads.
    geoms_ += fmt::format(
        "    <geom name=\"touchdown_floor\" type=\"plane\" size=\"{0} {0} 20\" "
        "material=\"touchdown_floor\" group=\"1\" {1}/>\n",
        70.0 + reach, contact_);
    for (const Strip& strip : strips_) {
      strip_ = &strip;
      const Profile profile(strip);
      for (std::size_t i = 0; i < profile.segments().size(); ++i) add_ground(profile, i);
      for (const Profile::Edge& edge : profile.edges()) add_edge(profile, edge);
      for (const Mesh& mesh : visual_meshes(profile, strip.width)) add_mesh(mesh);
    }
    return "  <asset>\n" + assets_ + "  </asset>\n  <worldbody>\n" + geoms_ + "  </worldbody>\n";
  }

 private:
  double half_width() const { return 0.5 * strip_->width; }

  void add_collider(const std::string& attributes) {
    geoms_ += fmt::format("    <geom name=\"touchdown_terrain_{}\" {} group=\"3\" {}/>\n",
                          collider_count_++, attributes, contact_);
  }

  void add_box(double x0, double x1, double height) {
    if (x1 <= x0 || height <= 0.0) return;
    add_collider(fmt::format("type=\"box\" pos=\"{} {} {}\" size=\"{} {} {}\"", 0.5 * (x0 + x1),
                             strip_->y, 0.5 * height, 0.5 * (x1 - x0), half_width(), 0.5 * height));
  }

  void add_ground(const Profile& profile, std::size_t i) {
    const Profile::Segment& segment = profile.segments()[i];
    const Profile::Edge* edge = profile.edge_after(i);
    const double x1 = edge ? edge->tangent_x : segment.x1;
    if (segment.z0 == segment.z1) {
      add_box(segment.x0, x1, segment.z0);
      return;
    }
    // A slope is the top face of a slab. The upper end of the slab leans forward below the surface;
    // it must not reach through the face of a drop.
    const double slope = segment.slope();
    double thickness = 0.05;
    if (edge && slope > 0.0) {
      thickness = std::clamp((edge->x - x1) * segment.length_per_x() / slope, 0.01, thickness);
    }
    const double length = (x1 - segment.x0) * segment.length_per_x();
    const double x = 0.5 * (segment.x0 + x1);
    const double nx = segment.nx();
    const double nz = segment.nz();
    add_collider(fmt::format("type=\"box\" pos=\"{} {} {}\" size=\"{} {} {}\" zaxis=\"{} 0 {}\"",
                             x - 0.5 * thickness * nx, strip_->y,
                             segment.z(x) - 0.5 * thickness * nz, 0.5 * length, half_width(),
                             0.5 * thickness, nx, nz));
  }

  void add_edge(const Profile& profile, const Profile::Edge& edge) {
    const Profile::Segment& segment = profile.segments()[edge.segment];
    if (edge.radius > 0.0) {
      add_box(edge.centre_x, edge.x - riser_recess, edge.centre_z);
      add_collider(fmt::format("type=\"capsule\" fromto=\"{0} {2} {1} {0} {3} {1}\" size=\"{4}\"",
                               edge.centre_x, edge.centre_z, strip_->y - half_width(),
                               strip_->y + half_width(), edge.radius));
    } else if (segment.z0 != segment.z1) {
      add_box(edge.x - 0.01, edge.x, edge.top - 0.01);
    }
    const double x = edge.tangent_x - 0.03;
    if (x - 0.012 < segment.x0) return;
    geoms_ += fmt::format(
        "    <geom type=\"plane\" pos=\"{} {} {}\" zaxis=\"{} 0 {}\" size=\"0.012 {} 1\" "
        "material=\"touchdown_edge\" group=\"1\" contype=\"0\" conaffinity=\"0\"/>\n",
        x, strip_->y, segment.z(x) + stripe_height, segment.nx(), segment.nz(), half_width());
  }

  void add_mesh(const Mesh& mesh) {
    std::string vertices, normals, faces;
    for (const Mesh::Vertex& v : mesh.vertices) {
      fmt::format_to(std::back_inserter(vertices), "{} {} {} ", v.x, strip_->y + v.y, v.z);
      fmt::format_to(std::back_inserter(normals), "{} {} {} ", v.nx, v.ny, v.nz);
    }
    for (const std::array<int, 3>& face : mesh.faces) {
      fmt::format_to(std::back_inserter(faces), "{} {} {} ", face[0], face[1], face[2]);
    }
    assets_ += fmt::format(
        "    <mesh name=\"touchdown_terrain_{}\" scale=\"1 1 1\" vertex=\"{}\" normal=\"{}\" "
        "face=\"{}\"/>\n",
        mesh_count_, vertices, normals, faces);
    geoms_ += fmt::format(
        "    <geom type=\"mesh\" mesh=\"touchdown_terrain_{}\" material=\"touchdown_step\" "
        "group=\"1\" contype=\"0\" conaffinity=\"0\"/>\n",
        mesh_count_++);
  }

  std::vector<Strip> strips_;
  const Strip* strip_ = nullptr;  ///< the current strip
  std::string contact_;
  std::string assets_;
  std::string geoms_;
  int collider_count_ = 0;
  int mesh_count_ = 0;
};

}  // namespace

std::vector<Mesh> visual_meshes(const Profile& profile, double width) {
  std::vector<Mesh> meshes;
  std::vector<OutlineFace> outline;
  double z = 0.0;  // where the outline so far ends
  const auto finish = [&] {
    if (!outline.empty()) meshes.push_back(close(outline, width));
    outline.clear();
  };
  for (std::size_t i = 0; i < profile.segments().size(); ++i) {
    const Profile::Segment& segment = profile.segments()[i];
    if (segment.z0 <= 0.0 && segment.z1 <= 0.0) {  // the floor itself
      finish();
      z = 0.0;
      continue;
    }
    if (z == 0.0) finish();
    if (segment.z0 > z) {  // a front
      outline.push_back({{segment.x0, z, -1.0, 0.0}, {segment.x0, segment.z0, -1.0, 0.0}});
    }
    add_segment(profile, i, outline);
    z = outline.back().to.z;
  }
  finish();
  return meshes;
}

std::string scene_mjcf(const Terrain& terrain) { return common_mjcf + Composer(terrain).compose(); }

}  // namespace touchdown::models
