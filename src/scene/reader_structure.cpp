// SPDX-License-Identifier: MIT
// Tables within tables, keys that are missing, unknown or without meaning.
#include "hyoryu/scene/reader_hint.hpp"
#include "parameter_table.hpp"
#include "reader_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hyoryu {

namespace {

/// The last names of the keys that stand directly in a table.
std::vector<std::string_view> keys_within(std::string_view schema)
{
    std::vector<std::string_view> keys;
    for (const Parameter& parameter : parameters()) {
        std::string_view key = parameter.key;
        if (!schema.empty()) {
            if (!key.starts_with(schema) || key.substr(schema.size(), 1) != ".") {
                continue;
            }
            key.remove_prefix(schema.size() + 1);
        }
        if (key.find('.') == std::string_view::npos) {
            keys.push_back(key);
        }
    }
    return keys;
}

std::string joined(std::string_view path, std::string_view key)
{
    return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

std::string lengths(const Parameter& rule, std::string_view elements)
{
    return rule.shortest == rule.longest
               ? fmt::format("{} {}", rule.longest, elements)
               : fmt::format("{} to {} {}", rule.shortest, rule.longest, elements);
}

} // namespace

TableReader::TableReader(Reading& reading, const TomlNode* node, std::string path,
                         std::string schema)
    : reading_(reading), node_(node), path_(std::move(path)), schema_(std::move(schema))
{
}

std::string TableReader::full(std::string_view key) const
{
    return joined(path_, key);
}

const Parameter& TableReader::parameter(std::string_view key) const
{
    const Parameter* found_parameter = find_parameter(joined(schema_, key));
    expects(found_parameter != nullptr);
    return *found_parameter;
}

bool TableReader::has(std::string_view key) const
{
    return node_ != nullptr && find_entry(*node_->table(), key) != nullptr;
}

void TableReader::require(std::string_view key)
{
    if (has(key) || abandoned_) {
        return;
    }
    const Parameter& rule = parameter(key);
    const bool always = chosen_.empty() || rule.fallback == required;
    error(key, always ? "is missing" : fmt::format("is missing, it is needed with {}", chosen_),
          fmt::format("{}: {}", key, rule.meaning));
}

const TomlNode* TableReader::ask(std::string_view key)
{
    asked_.emplace_back(key);
    if (has(key)) {
        return &find_entry(*node_->table(), key)->node;
    }
    if (parameter(key).fallback == required) {
        require(key);
    }
    return nullptr;
}

const TomlArray* TableReader::ask_list(std::string_view key, std::string_view elements)
{
    const Parameter& rule = parameter(key);
    const TomlNode* node = ask(key);
    if (node == nullptr) {
        return nullptr;
    }
    const TomlArray* items = node->array();
    if (items == nullptr) {
        reading_.error(
            *node, full(key),
            fmt::format("expected a list of {}, found {}", lengths(rule, elements), found(*node)));
        return nullptr;
    }
    const auto count = static_cast<int>(items->size());
    if (count < rule.shortest || count > rule.longest) {
        reading_.error(*node, full(key),
                       fmt::format("expected {}, found {}", lengths(rule, elements), count));
        return nullptr;
    }
    return items;
}

TableReader TableReader::table(std::string_view key)
{
    const std::string path = full(key);
    const std::string schema = joined(schema_, key);
    asked_.emplace_back(key);
    const TomlNode* node = has(key) ? &find_entry(*node_->table(), key)->node : nullptr;
    if (node != nullptr && node->table() == nullptr) {
        const bool list = node->array() != nullptr;
        reading_.error(*node, path, fmt::format("expected a table, found {}", found(*node)),
                       list ? fmt::format("there is one only: write [{}]", schema) : "");
        TableReader none(reading_, nullptr, path, schema);
        none.abandon();
        return none;
    }
    return {reading_, node, path, schema};
}

std::vector<TableReader> TableReader::tables(std::string_view key)
{
    asked_.emplace_back(key);
    std::vector<TableReader> readers;
    if (!has(key)) {
        return readers;
    }
    const std::string schema = joined(schema_, key) + "[]";
    const TomlNode& node = find_entry(*node_->table(), key)->node;
    const TomlArray* items = node.array();
    if (items == nullptr) {
        reading_.error(node, full(key),
                       fmt::format("expected a list of tables, found {}", found(node)),
                       fmt::format("write [[{}]], once for each", joined(schema_, key)));
        return readers;
    }
    for (std::size_t k = 0; k < items->size(); ++k) {
        const std::string path = fmt::format("{}[{}]", full(key), k);
        const TomlNode& item = (*items)[k];
        if (item.table() == nullptr) {
            reading_.error(item, path, fmt::format("expected a table, found {}", found(item)));
        } else {
            readers.emplace_back(reading_, &item, path, schema);
        }
    }
    return readers;
}

void TableReader::error(std::string_view key, std::string what, std::string hint)
{
    if (has(key)) {
        reading_.error(find_entry(*node_->table(), key)->node, full(key), std::move(what),
                       std::move(hint));
    } else if (node_ != nullptr && !path_.empty()) {
        reading_.error(*node_, full(key), std::move(what), std::move(hint));
    } else {
        reading_.error(Place{}, -1, full(key), std::move(what), std::move(hint));
    }
}

void TableReader::error_at(std::string_view key, std::size_t index, std::string what,
                           std::string hint)
{
    const TomlNode& list = find_entry(*node_->table(), key)->node;
    reading_.error((*list.array())[index], fmt::format("{}[{}]", full(key), index), std::move(what),
                   std::move(hint));
}

void TableReader::report_unknown(const TomlEntry& entry)
{
    const std::string schema_key = joined(schema_, entry.key);
    for (const PlannedKey& planned : planned_keys()) {
        if (planned.key == schema_key && planned.value.empty()) {
            reading_.error(entry.place, entry.node.override_number, full(entry.key),
                           "this version does not have this key yet",
                           fmt::format("it has {}", quoted_list(keys_within(schema_))));
            return;
        }
    }
    std::vector<std::string_view> names = keys_within(schema_);
    for (std::string_view& name : names) {
        name = name.substr(0, name.find('['));
    }
    const std::string hint = did_you_mean(entry.key, names);
    reading_.error(entry.place, entry.node.override_number, full(entry.key), "unknown key",
                   hint.empty() ? fmt::format("known here: {}", quoted_list(names)) : hint);
}

void TableReader::report_unused(const TomlEntry& entry)
{
    const std::vector<std::string_view> used(asked_.begin(), asked_.end());
    reading_.error(entry.place, entry.node.override_number, full(entry.key),
                   chosen_.empty() ? "has no meaning in this scene"
                                   : fmt::format("has no meaning with {}", chosen_),
                   chosen_.empty() ? "" : fmt::format("what has: {}", quoted_list(used)));
}

void TableReader::finish()
{
    if (node_ == nullptr) {
        return;
    }
    for (const TomlEntry& entry : *node_->table()) {
        if (std::find(asked_.begin(), asked_.end(), entry.key) != asked_.end()) {
            continue;
        }
        if (find_parameter(joined(schema_, entry.key)) == nullptr) {
            report_unknown(entry);
        } else if (!abandoned_) {
            report_unused(entry);
        }
    }
}

} // namespace hyoryu
