// SPDX-License-Identifier: MIT
// A state that a run may return to, on the disk instead of in memory.
#pragma once

#include "hyoryu/core/snapshot.hpp"

#include <filesystem>
#include <memory>

namespace hyoryu {

/// A copy of a state in a file without a name. The system removes the file when it is closed, also
/// if the process is killed. Nothing forces the bytes to the disk: the file is of use to this
/// process only.
class KeptState {
public:
    /// Writes all arrays of a state to a new file in `folder`. Throws IoError if it cannot be
    /// written.
    KeptState(const std::filesystem::path& folder, const StateOnDemand& state);
    ~KeptState();
    KeptState(KeptState&&) noexcept;
    KeptState& operator=(KeptState&&) noexcept;

    /// Writes another state over this one, which is lost also if it throws: nothing else may use
    /// the object after an IoError.
    void replace(const StateOnDemand& state);

    /// The state, whose arrays are read when they are requested, any number of times. Valid for as
    /// long as this object. Throws IoError if an array cannot be read.
    StateOnDemand on_demand() const;
    /// The state in memory.
    Snapshot snapshot() const;

private:
    class File;
    struct Place {
        std::uintmax_t offset = 0; // in the file [B]
        std::size_t count = 0;     // values
        Column kind;               // name, unit and type; no values
    };
    Column read(const Place& place) const;

    std::unique_ptr<File> file_;
    std::map<std::string, Place> arrays_;
    std::map<std::string, std::string> texts_;
};

} // namespace hyoryu
