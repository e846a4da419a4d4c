#pragma once

#include "solver/accuracy/back_flux.h"
#include "solver/accuracy/check_points.h"
#include "solver/accuracy/coarse_solution.h"
#include "solver/accuracy/gather_noise.h"
#include "solver/accuracy/judge.h"
#include "solver/accuracy/outside_flux.h"
#include "solver/accuracy/shown_places.h"
#include "solver/display/display_pass.h"

#include <memory>
#include <optional>

namespace patchlight {

/// What one round of gathering aims at.
struct GatherAim {
    double direct = 0.0, indirect = 0.0;  // that interpolation may miss of either, over `norm` [1]
    DirectEffort effort;
    bool direct_anew = false;  // at all vertices, as there are more samples now
    int rays = 32;             // at a point
    enum class Indirect {
        anew,    // reads what was displayed before
        joined,  // to what the round before gathered: more rays, finer
        kept,    // as the round before gathered it: only direct light is refined
    };
    Indirect gathered = Indirect::anew;
};

/// How well the light that is displayed is accounted for.
struct EnergyAim {
    std::size_t outside_rays = 4096;  // count what meets backs or leaves the scene
    std::size_t back_rays = 0;        // gather what meets backs there
    double noise = 1.0;      // of the light given off: more rays count where they leave more
    double balanced = 1e-4;  // of the light given off: what is missing is not worth a correction
    double likely = 1e-2;    // of the light that arrives, what a field is usually missing
};

/// For a target; whether light leaves the scene or meets backs [1].
EnergyAim energy_aim_for(double target, bool is_open, bool meets_backs);

/// The light of a scene as it is displayed, and the coarse solution behind it. Each round gathers
/// from what a round before displayed, and sends on with the coarse transport what that changed.
class GatheredLight {
  public:
    GatheredLight(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                  const MeshLines& lines, std::uint64_t seed, StopTokens stops);

    /// Direct light at the corners of patches and the coarse solution that follows. `backs`: the
    /// share of each patch's light that lands on backs.  `effort` grows until what samples of lamps
    /// leave of noise is within `noise` of the norm. False if the work was stopped.
    bool start(const CoarseTransport& transport, const std::vector<double>& backs,
               const EnergyAim& energy, DirectEffort& effort, double noise, double tolerance,
               const CoarseTransport::Observe& observe);
    /// One round. False if the work was stopped: then what is displayed is as before, or if there
    /// was nothing what is known by then.
    bool gather(const GatherAim& aim, double tolerance, const CoarseTransport::Observe& observe);

    /// What errors are beside: √∫ Y(B - E)² dA, or where nothing is sent back √∫ Y² dA of what
    /// arrives, as the display weighs it [W/m].
    double norm() const;
    bool reflects() const { return coarse_->norm() > hardly_any(); }
    CheckReport check(const CheckEffort& effort, std::uint64_t seed) const;
    ReflectedLight reflected() const;
    /// That lamps shine through.
    bool has_gaps() const { return !pass_.points().gather().apertures().empty(); }
    /// Whether rays of the last round read the coarse solution, not what was displayed.
    bool read_coarsely() const { return read_coarsely_; }
    /// What the last round changed, over `norm` [1].
    double correction() const { return correction_.size * coarse_->norm() / norm(); }

    /// Where the light that is displayed goes; what is missing of it was corrected as far as it is
    /// sure.
    const EnergyReport& energy() const { return energy_; }

    const TreeDisplay* shown() const { return shown_ ? &*shown_ : nullptr; }
    ShownPlaces places() const { return {scene_, mesh_, rays_, locator_, pass_.tree(), *shown_}; }
    const std::vector<Rgb>& irradiance() const { return irradiance_; }  // means of patches [W/m²]
    const ReflectedField* field() const { return field_.get(); }
    const GatherNoise& noise();  // measured when first asked for
    const std::optional<GatherNoise>& known_noise() const { return noise_; }
    const DisplayPass& pass() const { return pass_; }
    /// What showing the field once takes about.
    double seconds_to_show() const {
        return seconds_per_vertex_ * static_cast<double>(pass_.tree().vertices().size());
    }
    /// Where indirect light was found to be missed, the next round gathers more closely.
    void share_rays(double least_cosine) { pass_.share_rays(least_cosine); }
    void look_closer(std::span<const PointMiss> indirect) { pass_.look_closer(indirect); }
    /// By what was gathered as `aim` has it; rays outside and of check points are not among them.
    double rays_taken(const GatherAim& aim) const {
        return static_cast<double>(pass_.indirect().gathered()) * aim.rays +
               static_cast<double>(pass_.direct().gathered()) * aim.effort.first;
    }
    /// The coarse solution, once there is one.
    const CoarseSolution* coarse() const { return coarse_ ? &*coarse_ : nullptr; }
    const std::vector<Rgb>& direct_means() const { return direct_means_; }  // of patches [W/m²]

  private:
    void sort_exitance();
    double hardly_any() const;
    double mean_irradiance() const;  // as the coarse solution has it [W/m²]
    SplitIrradiance means_of(const TreeDisplay& shown) const;
    FieldTable table_of(const TreeDisplay& shown) const;
    bool solve_coarse(double tolerance, const CoarseTransport::Observe& observe);
    std::shared_ptr<const ReflectedField> make_field(FieldTable table) const;
    void read_coarse();
    void read_newest();
    void balance(double tolerance);
    OutsideFlux light_astray();
    void show(const SplitIrradiance& gathered);
    void show_what_there_is(double tolerance, const CoarseTransport::Observe& observe);
    std::vector<Rgb> evened_out(const Rgb& missing, const std::vector<Rgb>& irradiance,
                                double tolerance) const;

    const Scene& scene_;
    const PatchMesh& mesh_;
    const RayScene& rays_;
    const CoplanarOverlaps& overlaps_;
    std::uint64_t seed_;
    DisplayPass pass_;
    PatchLocator locator_;
    std::vector<double> backs_;         // [1]
    std::vector<Rgb> listed_exitance_;  // per patch, of sources gathered from one by one [W/m²]
    std::vector<Rgb> other_exitance_;   // per patch: of the rest, which rays read [W/m²]
    const CoarseTransport* transport_ = nullptr;
    std::optional<CoarseSolution> coarse_;
    std::shared_ptr<const ReflectedField> field_, read_;  // displayed; what rays read
    std::vector<Rgb> field_means_, read_means_;           // of both, per patch [W/m²]
    std::vector<Rgb> direct_means_;  // per patch, straight from sources [W/m²]
    std::vector<Rgb> exact_direct_;  // the same by the matrix; right where nothing can shade
    std::vector<Rgb> irradiance_;
    CoarseSolution::Correction correction_;
    double shown_norm_ = 0.0;  // of what is displayed [W/m]
    EnergyReport energy_;
    EnergyAim energy_aim_;
    std::optional<BackGather> backs_open_;
    std::optional<TreeDisplay> shown_;
    bool read_coarsely_ = false;
    double seconds_per_vertex_ = 5e-7;  // of showing it
    std::size_t direct_shown_ = 0;  // vertices where direct light was gathered, when it was shown
    std::optional<GatherNoise> noise_;
};

}  // namespace patchlight
