// SPDX-License-Identifier: MIT
#include "case_files.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/plan.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <sstream>

namespace hyoryu {

namespace {

// The 64 bits of FNV-1a over the bytes of a file (Fowler, Noll and Vo 1991).
std::string hash_of(const std::string& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::uint64_t hash = 0xcbf29ce484222325U;
    std::array<char, 1U << 16U> block{};
    do {
        stream.read(block.data(), std::ssize(block));
        for (std::streamsize k = 0; k < stream.gcount(); ++k) {
            hash ^= static_cast<unsigned char>(block[static_cast<std::size_t>(k)]);
            hash *= 0x100000001b3U;
        }
    } while (stream);
    if (!stream.eof()) {
        throw IoError(fmt::format("`{}` cannot be read", file));
    }
    return fmt::format("{:016x}", hash);
}

std::string file_of(const Shape& shape)
{
    const auto* mesh = std::get_if<MeshShape>(&shape);
    const auto* particles = std::get_if<ParticleShape>(&shape);
    return mesh != nullptr ? mesh->file : particles != nullptr ? particles->file : std::string();
}

std::map<std::string, std::string> files_of(const Scene& scene)
{
    std::map<std::string, std::string> files; // by key
    const auto add = [&](const char* list, std::size_t k, const Shape& shape) {
        if (const std::string file = file_of(shape); !file.empty()) {
            files.emplace(fmt::format("{}[{}].file", list, k), file);
        }
    };
    for (std::size_t k = 0; scene.fluid && k < scene.fluid->blocks.size(); ++k) {
        add("fluid.block", k, scene.fluid->blocks[k].shape);
    }
    for (std::size_t k = 0; k < scene.walls.size(); ++k) {
        if (const auto* solid = std::get_if<SolidWall>(&scene.walls[k].geometry)) {
            add("wall", k, solid->shape);
        }
    }
    for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
        add("body", k, scene.bodies[k].shape);
    }
    return files;
}

std::map<std::string, std::string> hashes_in(const std::string& text)
{
    std::map<std::string, std::string> hashes; // by key
    std::istringstream lines(text);
    std::string key;
    for (std::string hash; lines >> key >> hash;) {
        hashes.emplace(key, hash);
    }
    return hashes;
}

} // namespace

Scene read_whole_case(const std::filesystem::path& file, const std::vector<std::string>& overrides)
{
    try {
        return read_case(file, overrides);
    } catch (const PlacedCaseError& error) {
        std::vector<Diagnostic> all = error.diagnostics();
        try {
            make_plan(error.scene(), fill(error.scene()));
        } catch (const CaseError& more) {
            all.insert(all.end(), more.diagnostics().begin(), more.diagnostics().end());
        }
        throw CaseError(all);
    }
}

std::string hashes_of_files(const Scene& scene)
{
    std::map<std::string, std::string> known; // many bodies may name one file
    std::string text;
    for (const auto& [key, file] : files_of(scene)) {
        const auto [at, is_new] = known.emplace(file, "");
        if (is_new) {
            at->second = hash_of(file);
        }
        text += fmt::format("{} {}\n", key, at->second);
    }
    return text;
}

std::vector<KeyDifference> file_differences(const std::string& before, const std::string& after)
{
    const auto now = hashes_in(after);
    std::vector<KeyDifference> differences;
    for (const auto& [key, hash] : hashes_in(before)) {
        const auto found = now.find(key);
        if (found != now.end() && found->second != hash) {
            differences.push_back({key, fmt::format("a file with the hash {}", hash),
                                   fmt::format("one with the hash {}", found->second)});
        }
    }
    return differences;
}

} // namespace hyoryu
