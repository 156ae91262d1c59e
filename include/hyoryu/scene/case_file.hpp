// SPDX-License-Identifier: MIT
// The case file: TOML text to Scene and back.
#pragma once

#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/scene.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hyoryu {

/// Mistakes in the tables `output`, `gauge` and `contact` alone, which place no particle, and in
/// `debris`, without which the rest of the scene is as it is: what the filled scene shows can be
/// looked for all the same.
class PlacedCaseError : public CaseError {
public:
    PlacedCaseError(const CaseError& mistakes, Scene scene);
    /// The case without those tables.
    const Scene& scene() const { return scene_; }

private:
    Scene scene_;
};

/// Reads a case file. `overrides` are texts `key.path=VALUE` (VALUE in TOML; a bare word is taken
/// as a string) that replace or add keys before anything is checked. Throws CaseError with every
/// mistake of the file: syntax, unknown keys (nearest known one as a hint), wrong types, units and
/// bounds, keys without meaning in this scene, unreadable meshes. It is a PlacedCaseError if none
/// of them is about what is placed.
Scene read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same from text; `file` is only named in messages and resolves relative mesh paths.
Scene parse_case(const std::string& text, const std::filesystem::path& file,
                 const std::vector<std::string>& overrides = {});

/// The case with every default written out. Reading it back gives an equal Scene, bit for bit.
std::string to_toml(const Scene& scene);

/// A diagnostic at `place` in the case file of `scene`, as yet without its source line; an empty
/// hint becomes the meaning of the key.
Diagnostic diagnostic_without_line(const Scene& scene, const Place& place, std::string key,
                                   std::string what, std::string hint = {});

/// Points diagnostics at the value of their key, in the file or in an override, and adds the source
/// lines. Reads the file once; changes nothing if it can no longer be read.
void show_places(const Scene& scene, std::vector<Diagnostic>& diagnostics);

/// One diagnostic with its source line. For many, `show_places` reads the file only once.
Diagnostic diagnostic_at(const Scene& scene, const Place& place, std::string key, std::string what,
                         std::string hint = {});

} // namespace hyoryu
