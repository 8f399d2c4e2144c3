// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <tuple>

#include "kernels/volume_maths.h"
#include "verify/checks.h"
#include "verify/compare.h"
#include "verify/inputs.h"
#include "verify/scenes.h"
#include "verify/trial.h"

namespace slambench {
namespace {

using Voxels = std::vector<Voxel>;

struct VolumeShape {
  Int3 resolution;
  Float3 size_m;
};

/// Cubes, and what is neither a cube nor made of cubes nor a multiple of 8.
constexpr VolumeShape volume_shapes[] = {{{64, 64, 64}, {4.0f, 4.0f, 4.0f}},
                                         {{37, 50, 29}, {4.0f, 4.0f, 4.0f}},
                                         {{72, 41, 83}, {3.1f, 3.9f, 4.3f}},
                                         {{8, 8, 8}, {4.0f, 4.0f, 4.0f}},
                                         {{9, 1, 70}, {2.5f, 4.0f, 3.7f}}};

std::string voxel_place(Int3 n, std::size_t index) {
  const auto x = static_cast<std::size_t>(n.x), y = static_cast<std::size_t>(n.y);
  return fmt::format("voxel ({}, {}, {})", index % x, index / x % y, index / (x * y));
}

Voxels random_voxels(Int3 resolution, Random* random) {
  Voxels voxels(voxel_count(resolution));
  for (Voxel& voxel : voxels) {
    if (random->chance(0.3)) continue;  // fresh
    voxel.tsdf = static_cast<std::int16_t>(random->index(2 * 32766 + 1) - 32766);
    voxel.weight = static_cast<std::int16_t>(random->index(101));
    if (random->chance(0.3)) voxel.tsdf = 32766;  // seen to be free
  }
  return voxels;
}

/// A ball, smooth everywhere, and weights that say it was seen.
Voxels ball_voxels(const VolumeShape& shape) {
  const Int3 n = shape.resolution;
  const Float3 voxel_m = voxel_size(n, shape.size_m);
  const Float3 center = shape.size_m * 0.5f;
  Voxels voxels;
  voxels.reserve(voxel_count(n));
  for (int z = 0; z < n.z; ++z) {
    for (int y = 0; y < n.y; ++y) {
      for (int x = 0; x < n.x; ++x) {
        const float distance = length(voxel_center(x, y, z, voxel_m) - center) - 0.9f;
        const float truncated = std::clamp(distance / 0.3f, -1.0f, 1.0f);
        voxels.push_back({static_cast<std::int16_t>(truncated * tsdf_scale), 5});
      }
    }
  }
  return voxels;
}

IntegrateParameters integrate_parameters(const View& view, float mu_m = 0.12f,
                                         float max_weight = 100) {
  return {to_rigid3f(view.T_volume_camera.inverse()), view.camera, mu_m, max_weight, 0.0001f};
}

// ---------------------------------------------------------------- integrate

struct IntegrateCase {
  std::string name;
  VolumeShape shape;
  Voxels before;  ///< empty: a fresh volume
  std::vector<View> views;
  float mu_m = 0.12f;
  float max_weight = 100;
};

View room_view(Size size, const Pose& pose) {
  return {depth_of(room_scene(4.0), pose, camera_for(size), size), camera_for(size), pose};
}

Pose looking(const Eigen::Vector3d& position_m, double yaw_rad, double pitch_rad) {
  Pose pose = Pose::Identity();
  pose.linear() = (Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();
  pose.translation() = position_m;
  return pose;
}

std::vector<View> views_around(Size size) {
  return {room_view(size, looking({1.93, 2.07, 0.91}, 0.02, -0.03)),
          room_view(size, looking({1.81, 1.97, 1.02}, 0.13, 0.05)),
          room_view(size, looking({2.21, 2.13, 0.83}, -0.21, 0.11)),
          room_view(size, looking({1.07, 1.53, 0.67}, 0.53, 0.23))};
}

void add_frames_that_change_nothing(std::vector<IntegrateCase>* cases, Random* random) {
  const VolumeShape& shape = volume_shapes[1];
  const Voxels before = random_voxels(shape.resolution, random);
  View blind = room_view({37, 23}, looking({1.9, 2.1, 0.9}, 0, 0));
  std::fill(blind.depth_m.begin(), blind.depth_m.end(), 0.0f);
  cases->push_back({"zeros", shape, before, {blind}});
  View away = room_view({37, 23}, looking({1.9, 2.1, 0.5}, 0, 0));
  away.T_volume_camera = looking({2, 2, -1}, 3.14159, 0);
  cases->push_back({"looking away", shape, before, {away}});
}

std::vector<IntegrateCase> integrate_cases(Trial& trial) {
  Random random = trial.random();
  std::vector<IntegrateCase> cases;
  const std::vector<View> views = views_around({64, 48}), wide_views = views_around({127, 65});
  for (const VolumeShape& shape : volume_shapes) {
    const std::string name = text(shape.resolution);
    cases.push_back({"room, fresh " + name, shape, {}, wide_views});
    cases.push_back({"room, random before " + name,
                     shape,
                     random_voxels(shape.resolution, &random),
                     {views[1]}});
  }
  const Pose first = views[0].T_volume_camera;
  for (const Size size : image_sizes) {
    cases.push_back({"room from " + text(size), volume_shapes[0], {}, {room_view(size, first)}});
  }
  IntegrateCase saturated{"weights at their limit", volume_shapes[2], {}, {}};
  for (int i = 0; i < 6; ++i) saturated.views.push_back(views[static_cast<std::size_t>(i % 2)]);
  saturated.max_weight = 3;
  cases.push_back(saturated);
  cases.push_back({"narrow band", volume_shapes[0], {}, views, 0.03f});

  View spoiled = views[0];
  spoil(&spoiled.depth_m, &random);
  View holes = views[1];
  for (float& depth : holes.depth_m) depth = random.chance(0.2) ? 0.0f : depth;
  cases.push_back({"holes", volume_shapes[1], {}, {holes, views[2]}});
  cases.push_back({"not finite", volume_shapes[1], {}, {spoiled}});
  View outside = views[0];
  outside.T_volume_camera = looking({2.03, 1.91, -1.57}, 0.1, -0.05);
  cases.push_back({"from outside the volume", volume_shapes[2], {}, {outside}});
  add_frames_that_change_nothing(&cases, &random);

  for (const Recording& recording : trial.recordings()) {
    IntegrateCase recorded{
        recording.name,
        {volume_resolution(recording.parameters), volume_size_m(recording.parameters)},
        {},
        {},
        static_cast<float>(recording.parameters.mu_m)};
    for (std::size_t i = 0; i < recording.frames.size(); ++i) {
      recorded.views.push_back(view(recording, i));
    }
    cases.push_back(std::move(recorded));
  }
  return cases;
}

void compare_voxels(Trial& trial, const IntegrateCase& c, const Voxels& expected,
                    const Voxels& found) {
  std::size_t changed = 0, apart = 0, weights = 0, worst = 0, other_weight = 0;
  int largest = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Voxel before = c.before.empty() ? Voxel{} : c.before[i];
    if (expected[i] == before && found[i] == before) continue;
    ++changed;
    const int distance = std::abs(expected[i].tsdf - found[i].tsdf);
    if (distance > 2) ++apart;
    if (distance > largest) {
      largest = distance;
      worst = i;
    }
    if (expected[i].weight != found[i].weight) {
      ++weights;
      other_weight = i;
    }
  }
  const auto share = [&](std::size_t part) {
    return changed > 0 ? static_cast<double>(part) / static_cast<double>(changed) : 0;
  };
  const auto where = [&](std::size_t i) {
    return voxel_place(c.shape.resolution, i) + ": found " + describe(found[i]) + ", expected " +
           describe(expected[i]);
  };
  trial.at_most("distances apart by more than 2 units, of voxels", share(apart), where(worst));
  trial.at_most("weights that differ, of voxels", share(weights), where(other_weight));
}

// ---------------------------------------------------------------- raycast, render_volume

/// Something to look at, put into a volume in one way or the other.
struct SceneCase {
  std::string name;
  VolumeShape shape;
  Voxels voxels;            ///< written, unless empty
  std::vector<View> views;  ///< then integrated
};

void fill(Workbench& bench, const SceneCase& scene, Volume* volume) {
  if (!scene.voxels.empty()) bench.backend().write_volume(*volume, scene.voxels);
  for (const View& view : scene.views) {
    bench.backend().integrate(*volume, bench.input(view.depth_m), integrate_parameters(view));
  }
}

/// What the reference makes of the views.
Voxels fused(const VolumeShape& shape, const std::vector<View>& views) {
  const auto backend = create_backend(reference_backend, {});
  Workbench bench(*backend, reference_map);
  Volume volume = bench.volume(shape.resolution, shape.size_m);
  fill(bench, {"", shape, {}, views}, &volume);
  Voxels voxels;
  backend->read_volume(voxels, volume);
  return voxels;
}

std::vector<SceneCase> scene_cases(Trial& trial) {
  Random random = trial.random();
  std::vector<SceneCase> scenes;
  const std::vector<View> views = views_around({127, 65});
  for (const VolumeShape& shape : volume_shapes) {
    const std::string name = text(shape.resolution);
    scenes.push_back({"room written " + name, shape, fused(shape, views), {}});
    if (trial.candidate_supports(Kernel::integrate)) {
      scenes.push_back({"room integrated " + name, shape, {}, views});
    }
    scenes.push_back({"ball " + name, shape, ball_voxels(shape), {}});
  }
  scenes.push_back(
      {"noise", volume_shapes[1], random_voxels(volume_shapes[1].resolution, &random), {}});
  scenes.push_back({"empty", volume_shapes[1], {}, {}});
  return scenes;
}

RaycastParameters ray_parameters(const VolumeShape& shape, Size size, const Pose& pose) {
  const Float3 voxel_m = voxel_size(shape.resolution, shape.size_m);
  return {to_rigid3f(pose),
          camera_for(size),
          0.4f,
          4.0f,
          0.75f * 0.12f,
          std::min({voxel_m.x, voxel_m.y, voxel_m.z}),
          0.8f};
}

struct LookCase {
  std::string name;
  Size size;
  RaycastParameters parameters;
};

std::vector<LookCase> look_cases(const VolumeShape& shape) {
  const Pose inside = looking({1.95, 2.05, 0.93}, 0.03, -0.02);
  std::vector<LookCase> looks;
  const auto add = [&](const std::string& name, Size size, const Pose& pose) {
    looks.push_back({name + " " + text(size), size, ray_parameters(shape, size, pose)});
  };
  add("from inside", {97, 41}, inside);
  add("from outside", {37, 23}, looking({2.1, 1.8, -0.9}, 0.05, 0.03));
  add("from behind", {37, 23}, looking({1.9, 2.2, 5.1}, 3.1, 0.02));
  add("away", {3, 5}, looking({2, 2, -1}, 3.14, 0));
  for (const Size size : {Size{1, 1}, Size{3, 5}}) add("from inside", size, inside);
  // Rays along the axes have components that are zero.
  Pose straight = Pose::Identity();
  straight.translation() << 2.0, 2.0, 0.0;
  add("along z", {64, 48}, straight);
  looks.back().parameters.camera = {48, 48, 32, 24};
  return looks;
}

bool is_hit(const Float3& normal) { return normal.x != invalid_normal; }

using Surface = std::tuple<Image<Float3>, Image<Float3>>;

Surface run_raycast(Workbench& bench, const Volume& volume, const LookCase& look) {
  auto& vertices = bench.output<Float3>(look.size);
  auto& normals = bench.output<Float3>(look.size);
  bench.backend().raycast(vertices, normals, volume, look.parameters);
  return {bench.result(vertices), bench.result(normals)};
}

void compare_surfaces(Trial& trial, const Surface& expected, const Surface& found,
                      const std::string& look) {
  const auto& [vertices, normals] = expected;
  const auto& [found_vertices, found_normals] = found;
  const Spread hits = spread(normals, found_normals, 0, [](const Float3& e, const Float3& f) {
    return is_hit(e) == is_hit(f) ? 0 : 1;
  });
  trial.at_most("hits that differ, of pixels", hits.share_beyond(), look + ", " + hits.where);

  const double vertex_limit = trial.tolerance().allowed("vertex difference, m");
  const double normal_limit = trial.tolerance().allowed("normal difference");
  std::size_t apart = 0, first = 0;
  for (std::size_t i = vertices.count(); i-- > 0;) {
    const Float3 &en = normals.data()[i], &fn = found_normals.data()[i];
    if (is_hit(en) != is_hit(fn)) continue;
    const double v = vector_distance(vertices.data()[i], found_vertices.data()[i]);
    if (v <= vertex_limit && vector_distance(en, fn) <= normal_limit) continue;
    ++apart;
    first = i;
  }
  const std::string where =
      apart == 0
          ? ""
          : fmt::format("{}, {}: found vertex {}, normal {}, expected {}, {}", look,
                        place(vertices.size(), first), describe(found_vertices.data()[first]),
                        describe(found_normals.data()[first]), describe(vertices.data()[first]),
                        describe(normals.data()[first]));
  trial.at_most("vertices or normals apart by more, of pixels",
                static_cast<double>(apart) / static_cast<double>(vertices.count()), where);
}

/// Looking must not change what is looked at.
template <class Look>
auto unchanged(Workbench& bench, const Volume& volume, const Look& look) {
  Voxels before, after;
  bench.backend().read_volume(before, volume);
  auto result = look();
  bench.backend().read_volume(after, volume);
  std::size_t modified = 0;
  for (std::size_t i = 0; i < before.size(); ++i) modified += before[i] == after[i] ? 0 : 1;
  bench.note("input voxels modified", modified);
  return result;
}

constexpr ShadeParameters shading{{1.0f, 1.0f, -1.0f}, 0.1f};

/// Cast anew, and farther than what a raycast has seen, which the backend may draw from; that one
/// is empty where the backend has no raycast.
using Pictures = std::tuple<Image<Rgba8>, Image<Rgba8>>;

Image<Rgba8> run_render(Workbench& bench, const Volume& volume, const LookCase& look,
                        const SeenSurface* seen = nullptr) {
  auto& picture = bench.output<Rgba8>(look.size);
  bench.backend().render_volume(picture, volume, look.parameters, shading, seen);
  return bench.result(picture);
}

/// What was seen ends in the middle of the room: some rays have met a surface there, and some of
/// the others meet one behind.
Image<Rgba8> run_render_seen(Workbench& bench, const Volume& volume, const LookCase& look) {
  auto& vertices = bench.output<Float3>(look.size);
  auto& normals = bench.output<Float3>(look.size);
  SeenSurface seen{&vertices, &normals, look.parameters};
  seen.view.far_m *= 0.5f;
  bench.backend().raycast(vertices, normals, volume, seen.view);
  return run_render(bench, volume, look, &seen);
}

Pictures run_renders(Workbench& bench, const Volume& volume, const LookCase& look,
                     bool raycast_too) {
  return {run_render(bench, volume, look),
          raycast_too ? run_render_seen(bench, volume, look) : Image<Rgba8>{}};
}

void compare_pictures(Trial& trial, const Image<Rgba8>& expected, const Image<Rgba8>& found,
                      const std::string& look) {
  const double limit = trial.tolerance().allowed("level difference");
  const Spread s = spread(expected, found, limit, level_distance);
  trial.at_most("pixels apart by more, of pixels", s.share_beyond(), look + ", " + s.where);
}

void compare_both_pictures(Trial& trial, const Pictures& expected, const Pictures& found,
                           const std::string& look) {
  compare_pictures(trial, std::get<0>(expected), std::get<0>(found), look);
  const Image<Rgba8>& seen = std::get<1>(found);
  if (seen.count() > 0) {
    compare_pictures(trial, std::get<1>(expected), seen, look + ", farther than seen");
  }
}

/// A case per scene: from all sides, `run(bench, volume, look)` and `compare(trial, expected,
/// found, look's name)`.
template <class Run, class Compare>
void look_around(Trial& trial, const Run& run, const Compare& compare) {
  for (const SceneCase& scene : scene_cases(trial)) {
    const std::vector<LookCase> looks = look_cases(scene.shape);
    trial.add(
        scene.name,
        [&](Workbench& bench) {
          Volume volume = bench.volume(scene.shape.resolution, scene.shape.size_m);
          fill(bench, scene, &volume);
          return unchanged(bench, volume, [&] {
            std::vector<decltype(run(bench, volume, looks[0]))> seen;
            seen.reserve(looks.size());
            for (const LookCase& look : looks) seen.push_back(run(bench, volume, look));
            return seen;
          });
        },
        [&](const auto& expected, const auto& found) {
          for (std::size_t i = 0; i < looks.size(); ++i) {
            compare(trial, expected[i], found[i], looks[i].name);
          }
        });
  }
}

/// A volume of the paper's size, fused from several places and seen from these and others: what
/// rays skip there are whole bricks, more than a small volume has between camera and surface.
template <class Run, class Compare>
void look_into_large_volume(Trial& trial, const Run& run, const Compare& compare) {
  if (!trial.candidate_supports(Kernel::integrate)) return;
  const std::vector<View> views = views_around({320, 240});
  const SceneCase scene{"", {{256, 256, 256}, {4, 4, 4}}, {}, views};
  std::vector<LookCase> looks;
  const auto add = [&](const std::string& name, const Pose& pose) {
    const Size small{160, 120};
    looks.push_back({name, small, ray_parameters(scene.shape, small, pose)});
  };
  for (const View& view : views) add("as integrated", view.T_volume_camera);
  add("from between", looking({1.6, 1.9, 1.1}, 0.2, 0.1));
  add("from outside", looking({2.1, 1.8, -0.3}, 0.05, 0.03));
  trial.add(
      "room integrated " + text(scene.shape.resolution),
      [&](Workbench& bench) {
        Volume volume = bench.volume(scene.shape.resolution, scene.shape.size_m);
        fill(bench, scene, &volume);
        std::vector<decltype(run(bench, volume, looks[0]))> seen;
        for (const LookCase& look : looks) seen.push_back(run(bench, volume, look));
        return seen;
      },
      [&](const auto& expected, const auto& found) {
        for (std::size_t i = 0; i < looks.size(); ++i) {
          compare(trial, expected[i], found[i], looks[i].name);
        }
      });
}

/// Scenes one after the other in one volume: nothing of the first may be left, or remembered, when
/// the next is looked at from the same place.
template <class Run>
auto look_thrice(Workbench& bench, const SceneCase& first, const SceneCase& second,
                 const Run& run) {
  Volume volume = bench.volume(first.shape.resolution, first.shape.size_m);
  fill(bench, first, &volume);
  auto a = run(volume);
  fill(bench, second, &volume);
  auto b = run(volume);
  bench.backend().init_volume(volume);
  auto c = run(volume);
  return std::make_tuple(a, b, c);
}

/// Something integrated, and something else integrated or written on top.
std::vector<std::pair<SceneCase, SceneCase>> changing_scenes(Trial& trial) {
  const VolumeShape& shape = volume_shapes[0];
  const std::vector<View> views = views_around({64, 48});
  const SceneCase written{"", shape, fused(shape, {views[0]}), {}};
  const SceneCase ball{"written over written", shape, ball_voxels(shape), {}};
  std::vector<std::pair<SceneCase, SceneCase>> changes = {{written, ball}};
  if (trial.candidate_supports(Kernel::integrate)) {
    const SceneCase first{"", shape, {}, {views[0]}};
    changes.push_back({first, {"integrated over integrated", shape, {}, {views[1], views[3]}}});
    changes.push_back({first, {"written over integrated", shape, ball_voxels(shape), {}}});
    changes.push_back({written, {"integrated over written", shape, {}, {views[3]}}});
  }
  return changes;
}

LookCase look_from_inside(const VolumeShape& shape) { return look_cases(shape)[0]; }

}  // namespace

void check_init_volume(Trial& trial) {
  Random random = trial.random();
  for (const VolumeShape& shape : volume_shapes) {
    const Voxels before = random_voxels(shape.resolution, &random);
    trial.add(
        "random before " + text(shape.resolution),
        [&](Workbench& bench) {
          Volume volume = bench.volume(shape.resolution, shape.size_m);
          Voxels made, emptied;
          bench.backend().read_volume(made, volume);
          bench.backend().write_volume(volume, before);
          bench.backend().init_volume(volume);
          bench.backend().read_volume(emptied, volume);
          return std::make_tuple(made, emptied);
        },
        [&](const auto& expected, const auto& found) {
          const auto differ = [](const Voxels& a, const Voxels& b) {
            std::size_t n = a.size() == b.size() ? 0 : a.size();
            for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) n += a[i] == b[i] ? 0 : 1;
            return n;
          };
          trial.at_most("voxels that differ",
                        static_cast<double>(differ(std::get<0>(expected), std::get<0>(found)) +
                                            differ(std::get<1>(expected), std::get<1>(found))));
        });
  }
}

void check_integrate(Trial& trial) {
  for (const IntegrateCase& c : integrate_cases(trial)) {
    trial.add(
        c.name,
        [&](Workbench& bench) {
          Volume volume = bench.volume(c.shape.resolution, c.shape.size_m);
          if (!c.before.empty()) bench.backend().write_volume(volume, c.before);
          for (const View& view : c.views) {
            bench.backend().integrate(volume, bench.input(view.depth_m),
                                      integrate_parameters(view, c.mu_m, c.max_weight));
          }
          Voxels voxels;
          bench.backend().read_volume(voxels, volume);
          return voxels;
        },
        [&](const Voxels& expected, const Voxels& found) {
          compare_voxels(trial, c, expected, found);
        });
  }
}

void check_raycast(Trial& trial) {
  look_around(trial, run_raycast, compare_surfaces);
  look_into_large_volume(trial, run_raycast, compare_surfaces);
  for (const auto& [first, second] : changing_scenes(trial)) {
    const LookCase look = look_from_inside(first.shape);
    trial.add(
        second.name,
        [&, &a = first, &b = second](Workbench& bench) {
          return look_thrice(bench, a, b,
                             [&](const Volume& v) { return run_raycast(bench, v, look); });
        },
        [&](const auto& expected, const auto& found) {
          compare_surfaces(trial, std::get<0>(expected), std::get<0>(found), "before the change");
          compare_surfaces(trial, std::get<1>(expected), std::get<1>(found), "after it");
          compare_surfaces(trial, std::get<2>(expected), std::get<2>(found), "emptied");
        });
  }
}

void check_render_volume(Trial& trial) {
  const auto run = [raycast_too = trial.candidate_supports(Kernel::raycast)](
                       Workbench& bench, const Volume& volume, const LookCase& look) {
    return run_renders(bench, volume, look, raycast_too);
  };
  look_around(trial, run, compare_both_pictures);
  for (const auto& [first, second] : changing_scenes(trial)) {
    const LookCase look = look_from_inside(first.shape);
    trial.add(
        second.name,
        [&, &a = first, &b = second](Workbench& bench) {
          return look_thrice(bench, a, b,
                             [&](const Volume& volume) { return run(bench, volume, look); });
        },
        [&](const auto& expected, const auto& found) {
          compare_both_pictures(trial, std::get<0>(expected), std::get<0>(found),
                                "before the change");
          compare_both_pictures(trial, std::get<1>(expected), std::get<1>(found), "after it");
          compare_both_pictures(trial, std::get<2>(expected), std::get<2>(found), "emptied");
        });
  }
}

void check_memory(Trial& trial) {
  Random random = trial.random();
  const auto differ = [&](bool equal) { trial.at_most("values that differ", equal ? 0 : 1); };
  for (const Size size : image_sizes) {
    Image<float> depth(size);
    for (float& value : depth) value = random.uniform_f(-1, 1);
    spoil(&depth, &random);
    Image<std::uint16_t> raw(size);
    for (std::uint16_t& value : raw) value = static_cast<std::uint16_t>(random.index(65536));
    trial.add(
        "images " + text(size),
        [&](Workbench& bench) {
          return std::make_tuple(bench.result(bench.input(depth)), bench.result(bench.input(raw)));
        },
        [&](const auto& expected, const auto& found) { differ(same(expected, found)); });
  }
  for (const VolumeShape& shape : volume_shapes) {
    const Voxels voxels = random_voxels(shape.resolution, &random);
    trial.add(
        "volume " + text(shape.resolution),
        [&](Workbench& bench) {
          Volume volume = bench.volume(shape.resolution, shape.size_m);
          bench.backend().write_volume(volume, voxels);
          Voxels back;
          bench.backend().read_volume(back, volume);
          bench.note("values that differ", bench.backend().volume_bytes(volume) == 0 ? 1 : 0);
          return back;
        },
        [&](const Voxels& expected, const Voxels& found) { differ(same(expected, found)); });
  }
}

}  // namespace slambench
