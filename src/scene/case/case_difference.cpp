// SPDX-License-Identifier: MIT
// Walks two trees of TOML side by side.
#include "hyoryu/scene/case_difference.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/toml_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace hyoryu {

namespace {

constexpr std::size_t longest_value = 60; // characters of a value in a message

std::string value_text(const TomlNode& node);

struct ValueText {
    std::string operator()(const std::string& text) const { return fmt::format("\"{}\"", text); }
    std::string operator()(std::int64_t integer) const { return fmt::format("{}", integer); }
    std::string operator()(double number) const { return fmt::format("{}", number); }
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(const TomlDate&) const { return "a date"; }
    std::string operator()(const TomlTable&) const { return "a table"; }
    std::string operator()(const TomlArray& array) const
    {
        std::string text;
        for (const TomlNode& item : array) {
            text += (text.empty() ? "" : ", ") + value_text(item);
            if (text.size() > longest_value) {
                return fmt::format("a list of {}", array.size());
            }
        }
        return "[" + text + "]";
    }
};

std::string value_text(const TomlNode& node)
{
    return std::visit(ValueText{}, node.value);
}

bool is_list_of_tables(const TomlNode& node)
{
    const TomlArray* items = node.array();
    return items != nullptr && !items->empty() && items->front().table() != nullptr;
}

class Comparison {
public:
    // Either may be missing: nullptr.
    void compare(const std::string& path, const TomlNode* before, const TomlNode* after)
    {
        const TomlNode& one = before != nullptr ? *before : *after;
        if (before != nullptr && after != nullptr && *before == *after) {
            return;
        }
        const bool alike =
            before == nullptr || after == nullptr || before->value.index() == after->value.index();
        if (alike && one.table() != nullptr) {
            return compare_tables(path, before, after);
        }
        if (alike && (is_list_of_tables(one) || (after != nullptr && is_list_of_tables(*after)))) {
            return compare_lists(path, before, after);
        }
        found.push_back({path, before != nullptr ? value_text(*before) : "",
                         after != nullptr ? value_text(*after) : ""});
    }

    std::vector<KeyDifference> found;

private:
    void compare_tables(const std::string& path, const TomlNode* before, const TomlNode* after)
    {
        std::set<std::string> keys;
        for (const TomlNode* node : {before, after}) {
            for (const TomlEntry& entry : node != nullptr ? *node->table() : TomlTable{}) {
                keys.insert(entry.key);
            }
        }
        const auto at = [](const TomlNode* node, const std::string& key) -> const TomlNode* {
            const TomlEntry* entry = node != nullptr ? find_entry(*node->table(), key) : nullptr;
            return entry != nullptr ? &entry->node : nullptr;
        };
        for (const std::string& key : keys) {
            compare(path.empty() ? key : fmt::format("{}.{}", path, key), at(before, key),
                    at(after, key));
        }
    }

    void compare_lists(const std::string& path, const TomlNode* before, const TomlNode* after)
    {
        const auto size = [](const TomlNode* node) {
            return node != nullptr ? node->array()->size() : 0;
        };
        const auto at = [&](const TomlNode* node, std::size_t k) {
            return k < size(node) ? &(*node->array())[k] : nullptr;
        };
        for (std::size_t k = 0; k < std::max(size(before), size(after)); ++k) {
            compare(fmt::format("{}[{}]", path, k), at(before, k), at(after, k));
        }
    }
};

TomlNode parsed(const std::string& text)
{
    try {
        return parse_toml(text);
    } catch (const TomlFault& fault) {
        throw CaseError(fmt::format("a case of the checkpoint cannot be read: {}", fault.what));
    }
}

// The list of [[debris]]; none without them.
TomlNode debris_of(const GivenCase& given)
{
    TomlNode root = parse_toml(given.text);
    for (const std::string& text : given.overrides) {
        apply_override(root, text, 0); // the case was read with it
    }
    const TomlEntry* debris = find_entry(*root.table(), "debris");
    return debris != nullptr && debris->node.array() != nullptr ? debris->node
                                                                : TomlNode{TomlArray{}, {}, -1};
}

} // namespace

std::vector<KeyDifference> debris_differences(const GivenCase& before, const GivenCase& after)
try {
    const TomlNode one = debris_of(before);
    const TomlNode other = debris_of(after);
    Comparison comparison;
    comparison.compare("debris", &one, &other);
    return comparison.found;
} catch (const TomlFault&) {
    return {};
}

std::vector<std::string> piece_prefixes(const GivenCase& given)
try {
    const TomlNode debris = debris_of(given);
    std::vector<std::string> prefixes;
    for (const TomlNode& entry : *debris.array()) {
        const TomlEntry* name =
            entry.table() != nullptr ? find_entry(*entry.table(), "name") : nullptr;
        const auto* text = name != nullptr ? std::get_if<std::string>(&name->node.value) : nullptr;
        prefixes.push_back(text != nullptr ? *text + "."
                                           : fmt::format("debris.{}.", prefixes.size() + 1));
    }
    return prefixes;
} catch (const TomlFault&) {
    return {};
}

std::vector<KeyDifference> case_differences(const std::string& before, const std::string& after)
{
    const TomlNode one = parsed(before);
    const TomlNode other = parsed(after);
    Comparison comparison;
    comparison.compare("", &one, &other);
    return comparison.found;
}

bool may_change_on_resume(std::string_view key)
{
    constexpr std::array<std::string_view, 4> keys{"title", "time.end", "time.recover",
                                                   "particles.most"};
    return std::ranges::find(keys, key) != keys.end() || key.starts_with("output.") ||
           key == "gauge" || key.starts_with("gauge[");
}

} // namespace hyoryu
