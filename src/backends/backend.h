// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"
#include "core/trajectory.h"
#include "kernels/kernel.h"
#include "kernels/observer.h"
#include "kernels/tracking.h"
#include "kernels/types.h"

namespace slambench {

/// How the volume is stored; every kind gives the same results to 2 units of the stored distance.
enum class MapKind {
  grid,    ///< the paper's flat array
  bricks,  ///< the same voxels in bricks of 8^3, those in free space not stored singly
};
/// One line of the table of maps.
struct MapInfo {
  MapKind map;
  std::string_view name;
  std::string_view sentence;
};
std::span<const MapInfo> map_table();
std::string_view name(MapKind map);
/// Throws UsageError that lists the known names.
MapKind map_from_name(std::string_view name);

/// Memory that a backend owns: a host vector, a cl_mem, a device pointer. Opaque to all others.
class Storage {
 public:
  virtual ~Storage() = default;
};

/// An image in a backend's memory. Made by Backend::make_image, usable with that backend only. The
/// pixels lie row by row from the start of the storage, which may be larger than `size` says; then
/// no kernel touches the rest.
template <class T>
struct DeviceImage {
  Size size;
  std::unique_ptr<Storage> storage;
};

/// The volume in a backend's memory. Made by Backend::make_volume, which leaves it empty of
/// measurements. The origin of its frame is its corner, the axes are those of the start camera.
struct Volume {
  MapKind map = MapKind::grid;
  Int3 resolution;
  Float3 size_m;
  std::unique_ptr<Storage> storage;
};

/// The inputs of the whole ICP loop. Spans of images run from full resolution to the coarsest.
struct AlignInput {
  std::vector<const DeviceImage<Float3>*> vertices, normals;  ///< live, per level
  std::vector<DeviceImage<TrackData>*> rows;                  ///< per level, for track's output
  const DeviceImage<Float3>* model_vertices = nullptr;
  const DeviceImage<Float3>* model_normals = nullptr;
  std::vector<int> iterations;              ///< at most, per level
  TrackParameters parameters;               ///< T_volume_camera is the start
  Pose T_volume_camera = Pose::Identity();  ///< the start, in full precision
  double convergence = 0;  ///< a level ends when the norm of the update is below it
  bool keep_rows = false;  ///< the last iteration's rows are wanted (for render_track)
  bool fused = true;       ///< false: by the single kernels even where the backend does better
};

struct AlignResult {
  Pose T_volume_camera = Pose::Identity();
  Reduction last;               ///< of the last iteration; all zero when there was none
  int last_level = 0;           ///< the level that iteration ran on
  std::vector<int> iterations;  ///< done, per level
};

/// An input with these images, one of each level, finest first; all else at its default.
AlignInput align_input(const std::vector<DeviceImage<Float3>>& vertices,
                       const std::vector<DeviceImage<Float3>>& normals,
                       std::vector<DeviceImage<TrackData>>& rows);

/// A frame from its alignment to the next model. The poses of `integrate` and `raycast` are not
/// looked at: both are done where the alignment says.
struct AdvanceInput {
  AlignInput align;
  double condition = 0;   ///< as align() takes it
  TrackingLimits limits;  ///< of an alignment that is believed
  Volume* volume = nullptr;
  const DeviceImage<float>* depth_m = nullptr;   ///< for integrate
  std::optional<IntegrateParameters> integrate;  ///< nothing: not even a tracked frame is
  DeviceImage<Float3>* model_vertices = nullptr;
  DeviceImage<Float3>* model_normals = nullptr;
  RaycastParameters raycast;
};

struct AdvanceResult {
  AlignResult aligned;
  bool tracked = false;  ///< the alignment was believed; otherwise the frame stayed at its start
};

/// As kernels/tracking.h judges, by the level that the alignment ended on.
bool is_believed(const AlignInput& input, const AlignResult& aligned, const TrackingLimits& limits);

/// What raycast has found of a volume as it is now, for render_volume to draw from.
struct SeenSurface {
  const DeviceImage<Float3>* vertices = nullptr;
  const DeviceImage<Float3>* normals = nullptr;
  RaycastParameters view;
};

/// In the precision of the kernels.
Rigid3f to_rigid3f(const Pose& pose);
/// exp(twist) * pose: a step of the ICP.
Pose moved(const Pose& pose, const Twist& twist);
/// Euclidean norm over all six components.
double norm(const Twist& twist);

/// One programming model's implementation of the kernels.
///
/// The public functions check that shapes agree (std::invalid_argument: a programming error),
/// report to the observer, and call the implementation. Destinations come first and never alias a
/// source. Kernels may run asynchronously, in order; finish(), read() and what returns a value by
/// `return` wait.
class Backend {
 public:
  virtual ~Backend() = default;

  virtual std::string_view name() const = 0;
  /// The device this instance computes on, for people and the record.
  virtual std::string device() const = 0;
  /// Of that device, with its version; empty when there is none to speak of.
  virtual std::string driver() const { return ""; }
  /// Threads of the host that kernels run on; 0 on a device of its own.
  virtual int threads() const { return 0; }
  /// Processors of the host that kernels keep busy, the caller's included.
  virtual int busy_processors() const { return std::max(1, threads()); }
  /// Memory that this instance holds now on a device with memory of its own; none when it computes
  /// in the host's.
  virtual std::optional<std::size_t> device_bytes() const { return std::nullopt; }
  /// An honest answer: whether the kernel is implemented for this map.
  virtual bool supports(Kernel kernel, MapKind map) const = 0;
  /// The first kernel that a pipeline needs and that is missing for this map. `acquire` is none of
  /// a backend's, and for `align` there are the single kernels.
  std::optional<Kernel> missing_kernel(MapKind map) const;
  /// The SIMD instruction set that kernels were chosen for on this processor, by Highway's name
  /// ("AVX3", "NEON"); empty where none is chosen at run time.
  virtual std::string instruction_set() const { return {}; }
  /// True: kernels and transfers report their own times through kernel_measured and
  /// transfer_measured, at finish() at the latest, without any waiting of their own.
  virtual bool times_itself() const { return false; }
  virtual void finish() {}
  /// Whether advance() waits at its end only, so that a frame is best computed in one go. Only
  /// where times_itself(): in between, nobody has a look at a clock.
  virtual bool advances_in_one_go() const { return false; }

  /// Who is told about kernels from now on; null for nobody. Not owned.
  void observe(Observer* observer) { observer_ = observer; }

  // Memory. Throws UnavailableError when there is not enough.
  template <class T>
  DeviceImage<T> make_image(Size size) {
    return {size, allocate(size.count() * sizeof(T))};
  }
  template <class T>
  void write(DeviceImage<T>& destination, const Image<T>& source) {
    check(destination.size == source.size(), "write: sizes differ");
    upload(*destination.storage, source.data(), source.bytes());
  }
  template <class T>
  void read(Image<T>& destination, const DeviceImage<T>& source) {
    destination.resize(source.size);
    download(destination.data(), *source.storage, destination.bytes());
  }
  Volume make_volume(MapKind map, Int3 resolution, Float3 size_m);
  /// Every voxel, x fastest, whatever the map.
  virtual void read_volume(std::vector<Voxel>& destination, const Volume& source) = 0;
  virtual void write_volume(Volume& destination, const std::vector<Voxel>& source) = 0;
  /// Memory that the volume takes now.
  virtual std::size_t volume_bytes(const Volume& volume) const = 0;

  // The kernels; what each computes stands with its per-element function in src/kernels/.
  /// The 2 radius + 1 spatial weights of the bilateral filter, as an image of one row.
  void generate_gaussian(DeviceImage<float>& weights, float sigma_px);
  void init_volume(Volume& volume);
  /// Sub-samples by the ratio of the sizes, which must be integral and equal in x and y.
  void mm2meters(DeviceImage<float>& depth_m, const DeviceImage<std::uint16_t>& depth,
                 float units_per_m);
  void bilateral_filter(DeviceImage<float>& filtered_m, const DeviceImage<float>& depth_m,
                        const DeviceImage<float>& gaussian, float range_sigma_m);
  /// The destination has half the size, rounded down.
  void half_sample(DeviceImage<float>& half_m, const DeviceImage<float>& depth_m, float range_m);
  void depth2vertex(DeviceImage<Float3>& vertices, const DeviceImage<float>& depth_m,
                    Intrinsics camera);
  void vertex2normal(DeviceImage<Float3>& normals, const DeviceImage<Float3>& vertices);
  void track(DeviceImage<TrackData>& rows, const DeviceImage<Float3>& vertices,
             const DeviceImage<Float3>& normals, const DeviceImage<Float3>& model_vertices,
             const DeviceImage<Float3>& model_normals, const TrackParameters& parameters);
  Reduction reduce(const DeviceImage<TrackData>& rows);
  /// The least-squares motion by SVD; singular values below 1 / condition of the largest count as
  /// zero.
  Twist solve(const Reduction& reduction, double condition);
  void integrate(Volume& volume, const DeviceImage<float>& depth_m,
                 const IntegrateParameters& parameters);
  void raycast(DeviceImage<Float3>& vertices, DeviceImage<Float3>& normals, const Volume& volume,
               const RaycastParameters& parameters);
  void render_depth(DeviceImage<Rgba8>& image, const DeviceImage<float>& depth_m, float near_m,
                    float far_m);
  void render_track(DeviceImage<Rgba8>& image, const DeviceImage<TrackData>& rows);
  /// Casts the view's rays; a backend that can need not repeat those of `seen`, if that is given.
  void render_volume(DeviceImage<Rgba8>& image, const Volume& volume, const RaycastParameters& view,
                     const ShadeParameters& shading, const SeenSurface* seen = nullptr);
  /// The ICP loop, coarse to fine. Unless a backend does better and may: track, reduce and solve.
  AlignResult align(const AlignInput& input, double condition);
  /// align, then integrate if the alignment is believed and the frame is due, then raycast, from
  /// the aligned pose or, of a lost frame, from the start. At its end all that was asked for before
  /// is finished as well, and told.
  AdvanceResult advance(const AdvanceInput& input);

 protected:
  virtual std::unique_ptr<Storage> allocate(std::size_t bytes) = 0;
  virtual void upload(Storage& destination, const void* source, std::size_t bytes) = 0;
  virtual void download(void* destination, const Storage& source, std::size_t bytes) = 0;
  virtual std::unique_ptr<Storage> allocate_volume(MapKind map, Int3 resolution, Float3 size_m) = 0;

  virtual void do_generate_gaussian(DeviceImage<float>& weights, float sigma_px) = 0;
  virtual void do_init_volume(Volume& volume) = 0;
  virtual void do_mm2meters(DeviceImage<float>& depth_m, const DeviceImage<std::uint16_t>& depth,
                            float units_per_m) = 0;
  virtual void do_bilateral_filter(DeviceImage<float>& filtered_m,
                                   const DeviceImage<float>& depth_m,
                                   const DeviceImage<float>& gaussian, float range_sigma_m) = 0;
  virtual void do_half_sample(DeviceImage<float>& half_m, const DeviceImage<float>& depth_m,
                              float range_m) = 0;
  virtual void do_depth2vertex(DeviceImage<Float3>& vertices, const DeviceImage<float>& depth_m,
                               Intrinsics camera) = 0;
  virtual void do_vertex2normal(DeviceImage<Float3>& normals,
                                const DeviceImage<Float3>& vertices) = 0;
  virtual void do_track(DeviceImage<TrackData>& rows, const DeviceImage<Float3>& vertices,
                        const DeviceImage<Float3>& normals,
                        const DeviceImage<Float3>& model_vertices,
                        const DeviceImage<Float3>& model_normals,
                        const TrackParameters& parameters) = 0;
  virtual Reduction do_reduce(const DeviceImage<TrackData>& rows) = 0;
  virtual void do_integrate(Volume& volume, const DeviceImage<float>& depth_m,
                            const IntegrateParameters& parameters) = 0;
  virtual void do_raycast(DeviceImage<Float3>& vertices, DeviceImage<Float3>& normals,
                          const Volume& volume, const RaycastParameters& parameters) = 0;
  virtual void do_render_depth(DeviceImage<Rgba8>& image, const DeviceImage<float>& depth_m,
                               float near_m, float far_m) = 0;
  virtual void do_render_track(DeviceImage<Rgba8>& image, const DeviceImage<TrackData>& rows) = 0;
  virtual void do_render_volume(DeviceImage<Rgba8>& image, const Volume& volume,
                                const RaycastParameters& view, const ShadeParameters& shading) = 0;
  /// The same from rays that are those of the view, but may end before.
  virtual void do_render_seen(DeviceImage<Rgba8>& image, const Volume& volume,
                              const RaycastParameters& view, const ShadeParameters& shading,
                              const SeenSurface& seen);
  /// In double precision on the host, unless a backend has a reason.
  virtual Twist do_solve(const Reduction& reduction, double condition);
  /// The plain loop over track, reduce and solve; reports those, not `align`.
  virtual AlignResult do_align(const AlignInput& input, double condition);
  /// Whether do_align is the backend's own, and is to be reported as `align`.
  virtual bool fuses_align() const { return false; }
  /// The single steps, one after the other: what a do_advance of its own is held to. The pipeline
  /// takes its own steps where frames do not advance in one go.
  virtual AdvanceResult do_advance(const AdvanceInput& input);

  /// Throws std::invalid_argument unless the condition holds.
  static void check(bool condition, const char* message);
  Observer* observer() const { return observer_; }

 private:
  static void check_shapes(const AlignInput& input);
  /// Who times a launch from outside: nobody, when the device does it itself.
  Observer* launch_observer() const { return times_itself() ? nullptr : observer_; }

  Observer* observer_ = nullptr;
};

}  // namespace slambench
