// SPDX-License-Identifier: MIT
#include "step/row_solver.h"

#include "islands/large_islands.h"
#include "scene/error.h"
#include "schedule/joint_trees.h"
#include "schedule/motion_lists.h"
#include "solve/deformable_group.h"
#include "solve/exact_deformable_group.h"
#include "solve/link_group.h"
#include "solve/particle_contact_group.h"
#include "solve/surface_contact_group.h"
#include "step/contact_solver.h"
#include "step/energy_bound.h"
#include "step/free_islands.h"
#include "step/impact_stage.h"
#include "step/joint_energy_bound.h"
#include "step/joint_solver.h"
#include "step/push_out_shares.h"
#include "trees/joint_tree_group.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace plumb {
namespace {

/// How often shock propagation solves a level before it goes on to the next: until the points of a
/// pair agree, for the error that is left at one level tips over all that stands on it.
constexpr std::uint32_t kShockRounds = 16;

template <class Real, int W>
class RowSolverOf final : public RowSolver {
public:
    RowSolverOf(const World& world, const Plan& plan, Workers& workers)
        : settings_(world.settings),
          workers_(workers),
          shocks_(plan.runs(Effect::shock_propagation)),
          warm_start_(settings_.warm_start && !shocks_),
          solved_ties_(world),
          substeps_(static_cast<std::uint32_t>(world.steps * settings_.substeps)) {
        make_groups(world, plan);
        if (plan.runs(Effect::impacts)) impacts_.emplace(settings_, plan, workers);
        if (shocks_) shock_.emplace(plan, workers);
        if (plan.runs(Effect::exact_islands)) islands_.emplace(plan, workers, solved_ties_);
    }

    void load(const World& world) override {
        IslandGroup* exact = islands_ ? &*islands_ : nullptr;
        solved_ties_.clear();
        contacts_->load(world, nullptr, exact, [&](std::vector<BodyPair>& pairs) {
            if (exact_deformables_) exact_deformables_->take(world, pairs, solved_ties_);
        });
        if (impacts_) energy_.load(world, contacts_->pairs());
        free_islands_.load(world, contacts_->pairs());
        for (const auto& group : groups_) group->load(world);
        if (warm_start_) contacts_->load_impulses(world, exact);
        if (impacts_) impacts_->load(world, *contacts_, exact);
        if (!shocks_) return;
        find_levels(world, levels_);
        shock_->load(world, &levels_, nullptr, [](std::vector<BodyPair>&) {});
    }

    std::uint32_t begin_substep(const World& world, double h, Ledger& ledger) override {
        table_.begin(world, h);
        pass_.h = static_cast<Real>(h);
        pass_.inverse_h = static_cast<Real>(1 / h);
        pass_.stiffness = static_cast<Real>(share_of_iteration(settings_));
        pass_.recovery =
            static_cast<Real>(push_out(settings_, share_of_substep(settings_), h).most);
        pass_.warm_start = warm_start_;
        pass_.shared_cone = settings_.shared_cone;
        pass_.shared_push = settings_.shared_push;
        pass_.forwards = true;
        iterations_ = substeps_++;
        for (const auto& group : groups_) {
            const auto share = share_of(*group, ledger, Stage::begin);
            group->begin(world, table_.rows(), pass_, h);
        }
        std::uint32_t clamped = contacts_->clamped();
        if (islands_)
            clamped += islands_->begin(
                world, h, push_out(settings_, push_out_share(settings_.stiffness, h), h));
        if (shocks_) shock_->begin(world, table_.rows(), pass_, h);
        return clamped;
    }

    void solve_impacts(World& world, double h, ContactSums* sums) override {
        impacts_->solve(world, *contacts_, table_, h, sums);
    }

    void solve_velocities() override {
        if (contacts_->empty() && (!particle_contacts_ || particle_contacts_->empty())) return;
        for (const auto& group : groups_)
            if (warm_start_) group->warm_start(table_.rows(), pass_);
        workers_.run([this](std::uint32_t worker) {
            PassSettings<Real> pass = pass_;
            for (std::uint32_t i = 0; i < settings_.velocity_iterations; ++i) {
                pass.forwards = forwards(iterations_ + i);
                pass.iteration = i;
                for (const auto& group : groups_)
                    if (!group->empty()) group->iterate_velocities(table_.rows(), pass, worker);
            }
        });
        iterations_ += settings_.velocity_iterations;
    }

    void solve_positions(const World& world, StepReport& report, Ledger& ledger) override {
        const auto active = std::count_if(groups_.begin(), groups_.end(),
                                          [](const auto& group) { return !group->empty(); });
        trees_alone_ = false;
        if (active == 0) return;
        // trees alone are right after one iteration
        const bool alone = active == 1 && trees_ && !trees_->empty();
        const std::uint32_t iterations =
            alone ? std::min(settings_.position_iterations, 1u) : settings_.position_iterations;
        trees_alone_ = alone && iterations > 0;
        turned_ = false;
        workers_.run([&, this](std::uint32_t worker) {
            PassSettings<Real> pass = pass_;
            pass.rounds = rounds_;
            // what was turned opens a little, and is closed once more
            for (std::uint32_t i = 0; i < iterations + (alone && turned_); ++i) {
                pass.alone = alone && i == 0;
                pass.forwards = forwards(iterations_ + i);
                pass.iteration = i;
                for (pass.round = 0; pass.round < rounds_; ++pass.round)
                    iterate_positions(pass, worker, ledger);
                if (!free_islands_.empty()) turn_back(world, worker);
            }
            // a system is solved, and not iterated: it takes none
            if (iterations == 0 && exact_deformables_)
                iterate_positions(*exact_deformables_, pass, worker, ledger);
        });
        iterations_ += settings_.position_iterations;
        for (const auto& group : groups_) group->report(report);
    }

    void bound_energy(const World& world, double h) override {
        const PushOut push = push_out(settings_, share_of_substep(settings_), h);
        energy_.apply(world, *contacts_, table_.rows(), push, h);
    }
    void bound_joint_energy(World& world, double h) override {
        joint_energy_->apply(world, *contacts_, table_.rows(), h);
    }

    void solve_islands(const World& world, StepReport& report) override {
        islands_->solve(world, report);
    }

    StepResidual find_residual(const World& world) override {
        residuals_.begin();
        if (!has_residuals()) return {};
        find_islands(world);
        for (const auto& group : groups_) add_residuals(world, *group);
        if (islands_) islands_->add_residuals(world, residuals_);
        return residuals_.find(substep_of(world.settings));
    }
    const std::vector<IslandResidual>& island_residuals() const override {
        return residuals_.islands();
    }

    /// One iteration from the ground up in which the lower body of each pair is immovable
    /// (Guendelman et al.).
    void propagate_shock() override {
        if (contacts_->empty()) return;
        shock_->copy_impulses(*contacts_);
        PassSettings<Real> pass = shock_pass();
        pass.forwards = substeps_ % 2 == 0;  // the order of a pair's points favours no side
        workers_.run([&](std::uint32_t worker) {
            shock_->rounds_iteration(table_.rows(), pass, kShockRounds, worker);
        });
    }

    /// Shock propagation begins from the sums of the passes, and what it adds does not act below.
    void add_impulses(ContactSums& sums) override {
        (shocks_ ? *shock_ : *contacts_).add_impulses(sums);
        if (islands_) islands_->add_impulses(sums);
        if (particle_contacts_) particle_contacts_->add_impulses(sums);
        if (exact_deformables_) exact_deformables_->add_impulses(sums);
    }

    void take_changes(World& world) const override {
        table_.take_changes(world.bodies);
        table_.take_changes(world, world.particles);
        if (islands_) islands_->take_changes(world.bodies);
    }

    bool has_undisturbed_trees() const override {
        return trees_alone_ && !solved_ties_.any_joint();
    }

    void end_substep(World& world, Ledger& ledger) override {
        for (const auto& group : groups_) {
            const auto share = share_of(*group, ledger, Stage::joints);
            group->end_substep(world);
        }
        if (!islands_) return;
        islands_->store_tie_impulses(world);
        islands_->open_apart(world.bodies);
    }

    void end_step(World& world) override {
        for (const auto& group : groups_) group->end_step(world);
        if (!islands_) return;
        islands_->store_impulses(world.contacts);
        note_what_misses(world, residuals_);
        islands_->rest_ties(world);
    }

private:
    using Group = ConstraintGroup<Real>;

    template <class Kind, class... Arguments>
    Kind* add(Arguments&&... arguments) {
        auto group = std::make_unique<Kind>(std::forward<Arguments>(arguments)...);
        Kind* kind = group.get();
        groups_.push_back(std::move(group));
        return kind;
    }

    /// The groups in the order in which they are solved. Joints that form trees are solved exactly
    /// where the plan says so, the others by iterations.
    void make_groups(const World& world, const Plan& plan) {
        if (plan.runs(Effect::joints)) {
            joint_energy_.emplace(world);
            const bool grows = plan.runs(Effect::joint_trees);
            const JointForest forest = grows ? find_forest(world) : JointForest();
            joints_ = add<JointSolver<Real, W>>(
                world, grows ? forest.in_tree : std::vector<std::uint8_t>(world.joints.size(), 0),
                solved_ties_, workers_);
            if (grows && is_narrow(forest))
                trees_ = add<JointTreeGroup<Real, 1>>(world, forest, solved_ties_.joints, workers_);
            else if (grows)
                trees_ = add<JointTreeGroup<Real, W>>(world, forest, solved_ties_.joints, workers_);
        }
        const JoinedBodies<Real>* joined = nullptr;
        if (plan.runs(Effect::exact_deformables))
            exact_deformables_ = add<ExactDeformableGroup<Real>>(world, plan, workers_);
        else if (plan.runs(Effect::deformables))
            joined = &add<DeformableGroup<Real, W>>(world, workers_)->bodies();
        if (plan.runs(Effect::links))
            add<LinkGroup<Real>>(world, solved_ties_.links, joined, workers_);
        const bool apart = !plan.runs(Effect::exact_deformables);
        if (apart && plan.runs(Effect::surface_contacts))
            add<SurfaceContactGroup<Real>>(plan, workers_);
        contacts_ = add<ContactSolver<Real, W>>(plan, workers_);
        if (apart && plan.runs(Effect::particle_contacts))
            particle_contacts_ = add<ParticleContactGroup<Real, W>>(plan, workers_);
        for (const auto& group : groups_) rounds_ = std::max(rounds_, group->rounds());
    }

    /// One round of an iteration.
    void iterate_positions(const PassSettings<Real>& pass, std::uint32_t worker, Ledger& ledger) {
        for (const auto& group : groups_) iterate_positions(*group, pass, worker, ledger);
    }
    void iterate_positions(Group& group, const PassSettings<Real>& pass, std::uint32_t worker,
                           Ledger& ledger) {
        if (group.empty()) return;
        // by the clock of the first worker alone
        const auto share = worker == 0 ? share_of(group, ledger, Stage::positions) : std::nullopt;
        group.iterate_positions(table_.rows(), pass, worker);
    }

    /// What joints took of the angular momentum of what hangs by nothing.
    void turn_back(const World& world, std::uint32_t worker) {
        workers_.barrier();
        if (worker == 0) turned_ = free_islands_.turn_back(world, table_.rows());
        workers_.barrier();
    }

    bool has_residuals() const {
        return (islands_ && islands_->has_residuals()) ||
               std::any_of(groups_.begin(), groups_.end(),
                           [](const auto& group) { return group->has_residuals(); });
    }

    /// Exact islands know them, but for those of joints that are iterated where nothing touches.
    void find_islands(const World& world) {
        const bool known = islands_ && !(joints_ && joints_->has_residuals());
        if (known) return residuals_.take(world, islands_->choice().islands());
        held_rows_.clear();
        add_tied_rows(world, held_rows_);
        for (const auto& group : groups_) group->add_rows(held_rows_);
        if (islands_) islands_->add_rows(world, held_rows_);
        held_.find(held_rows_, {}, 0, world.dynamic_count);
        residuals_.take(world, held_);
    }

    /// Shock propagation has the last word about contacts.
    void add_residuals(const World& world, Group& group) {
        if (shocks_ && &group == contacts_)
            shock_->add_residuals(residuals_, world, table_.rows(), shock_pass());
        else
            group.add_residuals(residuals_, world, table_.rows(), pass_);
    }

    PassSettings<Real> shock_pass() const {
        PassSettings<Real> pass = pass_;
        pass.shared_cone = true;
        pass.shared_push = false;
        return pass;
    }

    /// Books what is done while it lives on a group's stage.
    static std::optional<ShareTimer> share_of(const Group& group, Ledger& ledger, Stage around) {
        using Share = std::optional<ShareTimer>;
        const bool apart = group.stage() != Stage::positions && group.stage() != around;
        return apart ? Share(std::in_place, ledger, group.stage(), around) : Share(std::nullopt);
    }

    bool forwards(std::uint32_t iteration) const {
        return !settings_.alternate_sweeps || iteration % 2 == 0;
    }

    const Settings settings_;
    Workers& workers_;
    bool shocks_;
    /// Shock propagation carries each level by itself; impulses of the step before would only stand
    /// in its way.
    bool warm_start_;
    VelocityTable<Real> table_;
    PassSettings<Real> pass_{};
    SolvedTies solved_ties_;
    std::vector<std::unique_ptr<Group>> groups_;  ///< in the order of an iteration
    std::uint32_t rounds_ = 1;                    ///< of an iteration of positions
    // those of the groups that stages of their own ask for
    ContactSolver<Real, W>* contacts_ = nullptr;
    ParticleContactGroup<Real, W>* particle_contacts_ = nullptr;
    ExactDeformableGroup<Real>* exact_deformables_ = nullptr;
    Group *joints_ = nullptr, *trees_ = nullptr;  // iterated; solved exactly
    std::optional<ContactSolver<Real, W>> shock_;
    std::optional<IslandGroup> islands_;
    std::optional<ImpactStage<Real, W>> impacts_;
    EnergyBound<Real, W> energy_;
    FreeIslands<Real> free_islands_;
    bool turned_ = false;  // one of them, after the last iteration
    std::optional<JointEnergyBound<Real, W>> joint_energy_;
    IslandResiduals residuals_;
    std::vector<BodyPair> held_rows_;  // that any constraint holds together
    ContactIslands held_;              // the islands that these make
    std::vector<std::uint32_t> levels_;
    std::uint32_t substeps_;  // since the start: each begins in the other direction
    std::uint32_t iterations_ = 0;
    bool trees_alone_ = false;  // solved, in the last substep, and nothing else
};

template <class Real>
std::unique_ptr<RowSolver> make_with_lanes(const World& world, const Plan& plan, Workers& workers) {
    const int widest = widest_lanes();
    const int lanes = lanes_of(world);
    if (lanes <= widest) {
        switch (lanes) {
            case 1:
                return std::make_unique<RowSolverOf<Real, 1>>(world, plan, workers);
            case 4:
                return std::make_unique<RowSolverOf<Real, 4>>(world, plan, workers);
            case 8:
                return std::make_unique<RowSolverOf<Real, 8>>(world, plan, workers);
            case 16:
                return std::make_unique<RowSolverOf<Real, 16>>(world, plan, workers);
            default:
                break;
        }
    }
    throw SceneError("", "/settings/lanes",
                     std::to_string(lanes) + " lanes cannot be run here; this processor runs 1, 4" +
                         (widest >= 8 ? ", 8" : "") + (widest >= 16 ? ", 16" : "") +
                         ", or 0 for what the scene calls for");
}

}  // namespace

int lanes_of(const World& world) {
    // a colour holds about a quarter of what touches or is jointed
    constexpr std::int32_t kColours = 4;
    if (world.settings.lanes != 0) return static_cast<int>(world.settings.lanes);
    const int widest = widest_lanes();
    if (world.moving_count() < 8 * kColours) return std::min(widest, 4);
    return world.moving_count() < 16 * kColours ? std::min(widest, 8) : widest;
}

std::unique_ptr<RowSolver> make_row_solver(const World& world, const Plan& plan, Workers& workers) {
    return world.settings.precision == Precision::single
               ? make_with_lanes<float>(world, plan, workers)
               : make_with_lanes<double>(world, plan, workers);
}

}  // namespace plumb
