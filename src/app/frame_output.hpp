// SPDX-License-Identifier: MIT
// Frames of a run. Of several processes each packs and writes its own particles, or those of a
// group of processes; the first one writes the data that all processes have, and the frame over the
// parts.
#pragma once

#include "hyoryu/io/results.hpp"
#include "hyoryu/ranks/groups.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <filesystem>
#include <memory>
#include <vector>

namespace hyoryu {

/// Every call is made by all processes that share the run.
class FrameOutput {
public:
    /// `comm`: null for one process. `groups`: of processes that write a file together.
    FrameOutput(const std::filesystem::path& folder, Comm* comm, const Groups& groups);

    /// Writes the data that do not change during the run: wall particles and surfaces of
    /// structures.
    void write_static(const Simulation& sim, const Bounds& domain);
    void write(const Simulation& sim);
    /// Removes every frame later than `time` [s].
    void forget_after(double time);
    /// Frames that are listed and not there; none on all processes but the first.
    std::vector<std::filesystem::path> missing();
    /// Waits until all frames are on disk.
    void finish();
    /// Cost of the thread that writes frames.
    FrameWriter::Cost cost() const;

private:
    bool is_first() const { return comm_ == nullptr || comm_->rank() == 0; }
    void write_cloud(Cloud own, FramePlace place);
    void write_shared(Cloud own, FramePlace place);
    Cloud gathered(Cloud own, const Cloud& head) const;
    void write_walls(const Simulation& sim, FramePlace place);
    Cloud share_of_walls(const Simulation& sim) const;

    Comm* comm_;
    Groups groups_;
    std::unique_ptr<FrameWriter> files_; // none where another process writes
};

} // namespace hyoryu
