#include "models/terrain_mjcf.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "models/profile.hpp"
#include "models/terrain_mesh.hpp"

namespace touchdown::models {
namespace {

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

std::string terrain_mjcf(const Terrain& terrain) { return Composer(terrain).compose(); }

}  // namespace touchdown::models
