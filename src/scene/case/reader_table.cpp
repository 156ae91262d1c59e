// SPDX-License-Identifier: MIT
// Tables within tables, keys that are missing, unknown or without meaning.
#include "reader_table.hpp"

#include "hyoryu/scene/reader_hint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

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
    return path.empty() || key.empty() ? fmt::format("{}{}", path, key)
                                       : fmt::format("{}.{}", path, key);
}

// A table as it is written: "body[].copies" as "[body.copies]".
std::string header_of(std::string_view schema)
{
    const std::string name = plain_key(schema);
    return schema.ends_with(']') ? fmt::format("[[{}]]", name) : fmt::format("[{}]", name);
}

// Of a key that belongs to a table around this one, as those do which follow the header of a table
// within it; empty if none of them has the key.
std::string of_table_around(std::string_view schema, std::string_view key)
{
    for (std::string_view around = schema; !around.empty();) {
        const std::size_t dot = around.rfind('.');
        around = around.substr(0, dot == std::string_view::npos ? 0 : dot);
        if (find_parameter(joined(around, key)) != nullptr) {
            return fmt::format("it is a key of {}: write it above {}",
                               around.empty() ? "the case itself" : header_of(around),
                               header_of(schema));
        }
    }
    return "";
}

} // namespace

TableReader::TableReader(Reading& reading, const TomlNode* node, std::string path,
                         std::string schema, std::size_t number)
    : reading_(reading), node_(node), path_(std::move(path)), schema_(std::move(schema)),
      number_(number)
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

const TomlNode* TableReader::find(std::string_view key) const
{
    const TomlEntry* entry = node_ != nullptr ? find_entry(*node_->table(), key) : nullptr;
    return entry != nullptr ? &entry->node : nullptr;
}

bool TableReader::has(std::string_view key) const
{
    return find(key) != nullptr;
}

bool TableReader::sound(std::string_view key) const
{
    return std::ranges::find(sound_, key) != sound_.end();
}

bool TableReader::mistaken(std::initializer_list<std::string_view> keys) const
{
    return std::ranges::any_of(keys, [&](std::string_view key) {
        return std::ranges::find(mistaken_, key) != mistaken_.end();
    });
}

std::size_t TableReader::count(std::string_view key) const
{
    return sound(key) ? find(key)->array()->size() : 0;
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

const TomlNode* TableReader::ask(std::string_view key, Default fallback)
{
    asked_.emplace_back(key);
    const TomlNode* node = find(key);
    if (node == nullptr && (fallback == required || fallback == needed)) {
        require(key);
    }
    return node;
}

bool TableReader::pick(const Parameter& rule, std::size_t& index, Default fallback)
{
    const TomlNode* node = ask(rule.key, fallback);
    std::string value(fallback == required ? "" : rule.choices[index]);
    if (node != nullptr) {
        const bool is_text = std::holds_alternative<std::string>(node->value);
        const Asked asked{reading_, *node, rule, full(rule.key)};
        value.clear();
        if (!is_text) {
            asked.refuse_kind("one of " + quoted_list(rule.choices));
        } else if (read(asked, value)) {
            sound_.push_back(rule.key);
        }
        if (!sound(rule.key)) {
            mistaken_.push_back(rule.key);
        }
    }
    if (chosen_.empty()) {
        chosen_ = fmt::format("{} = \"{}\"", rule.key, value);
    }
    if (value.empty()) {
        abandoned_ = true;
        return false;
    }
    index = at(std::ranges::find(rule.choices, value) - rule.choices.begin());
    return true;
}

void TableReader::direction(std::string_view name, Vec3& member, std::string_view meaning,
                            Default fallback)
{
    planar(name, member, "", meaning, fallback);
    const double norm = member.norm();
    if (!(norm > 0) || !std::isfinite(norm)) {
        error(name,
              reading_.dimensions == 2
                  ? "has no direction in the x-z plane, in which a case of two dimensions lies"
                  : "has no direction");
        return;
    }
    // One that this program wrote is a unit up to rounding and is taken bit by bit.
    constexpr double rounding = 1e-14;
    member = std::abs(sq(norm) - 1) < rounding ? member : Vec3(member.normalized());
}

TableReader TableReader::inside(std::string_view key)
{
    const std::string path = full(key);
    const std::string schema = joined(schema_, key);
    asked_.emplace_back(key);
    const TomlNode* node = find(key);
    if (node != nullptr && node->table() == nullptr) {
        const bool list = node->array() != nullptr;
        reading_.error(
            *node, path, fmt::format("expected a table, found {}", found(*node)),
            fmt::format("{}write {}", list ? "only one is allowed: " : "", header_of(schema)));
        mistaken_.emplace_back(key);
        TableReader none(reading_, nullptr, path, schema);
        none.abandon();
        return none;
    }
    return {reading_, node, path, schema};
}

std::vector<TableReader> TableReader::each_inside(std::string_view key)
{
    asked_.emplace_back(key);
    std::vector<TableReader> readers;
    const TomlNode* node = find(key);
    if (node == nullptr) {
        return readers;
    }
    const std::string schema = joined(schema_, key) + "[]";
    const std::string write = fmt::format("write {} once for each table", header_of(schema));
    const TomlArray* items = node->array();
    if (items == nullptr) {
        reading_.error(*node, full(key),
                       fmt::format("expected a list of tables, found {}", found(*node)), write);
        mistaken_.emplace_back(key);
        return readers;
    }
    for (std::size_t k = 0; k < items->size(); ++k) {
        const std::string path = fmt::format("{}[{}]", full(key), k);
        const TomlNode& item = (*items)[k];
        if (item.table() == nullptr) {
            reading_.error(item, path, fmt::format("expected a table, found {}", found(item)),
                           write);
            mistaken_.emplace_back(key);
        } else {
            readers.emplace_back(reading_, &item, path, schema, k + 1);
        }
    }
    return readers;
}

void TableReader::error(std::string_view key, std::string what, std::string hint)
{
    if (const TomlNode* node = find(key)) {
        reading_.error(*node, full(key), std::move(what), std::move(hint));
    } else if (node_ != nullptr && !path_.empty()) {
        reading_.error(*node_, full(key), std::move(what), std::move(hint));
    } else {
        reading_.error(Place{}, -1, full(key), std::move(what), std::move(hint));
    }
}

void TableReader::error_at(std::string_view key, std::size_t index, std::string what,
                           std::string hint)
{
    reading_.error((*find(key)->array())[index], fmt::format("{}[{}]", full(key), index),
                   std::move(what), std::move(hint));
}

void TableReader::warn(std::string_view key, std::string what, std::string hint)
{
    const TomlNode* node = find(key);
    reading_.warn(node != nullptr ? node->place : place(), full(key), std::move(what),
                  std::move(hint));
}

void TableReader::flatten(std::string_view name, std::string_view unit, Vec3& vector)
{
    if (reading_.dimensions != 2) {
        return;
    }
    if (vector.y() != 0 && unit.starts_with("m/s")) {
        const bool alone = vector.x() == 0 && vector.z() == 0;
        warn(name,
             fmt::format("{}: with `dimensions = 2` the case lies in the x-z plane",
                         alone ? "points along y and has no effect" : "y has no effect"),
             "the numbers are x, y and z; z points up");
    }
    vector.y() = 0;
}

void TableReader::report_unknown(const TomlEntry& entry)
{
    std::vector<std::string_view> names = keys_within(schema_);
    for (std::string_view& name : names) {
        name = name.substr(0, name.find('['));
    }
    std::string hint = of_table_around(schema_, entry.key);
    hint = hint.empty() ? did_you_mean(entry.key, names) : hint;
    reading_.error(entry.place, entry.node.override_number, full(entry.key), "unknown key",
                   hint.empty() ? fmt::format("known keys: {}", quoted_list(names)) : hint);
}

void TableReader::report_unused(const TomlEntry& entry)
{
    const std::vector<std::string_view> used(asked_.begin(), asked_.end());
    reading_.error(entry.place, entry.node.override_number, full(entry.key),
                   chosen_.empty() ? "has no meaning in this scene"
                                   : fmt::format("has no meaning with {}", chosen_),
                   chosen_.empty() ? "" : fmt::format("keys used here: {}", quoted_list(used)));
}

// A key of a table whose meaning was lost with a mistake, such as the size of a shape of an unknown
// name: its kind, its unit and its choices are the same for all meanings, bounds and lengths are
// not.
void TableReader::check_kind(const TomlEntry& entry)
{
    Parameter rule = *find_parameter(joined(schema_, entry.key));
    rule.key = entry.key;
    rule.minimum = -std::numeric_limits<double>::infinity();
    rule.maximum = std::numeric_limits<double>::infinity();
    rule.minimum_excluded = false;
    rule.shortest = 0;
    rule.longest = std::numeric_limits<int>::max();
    const auto check = [&]<class T>(T value) {
        if (!read({reading_, entry.node, rule, full(entry.key)}, value)) {
            mistaken_.emplace_back(entry.key);
        }
    };
    switch (rule.kind) {
    case ValueKind::number:
        return check(double{});
    case ValueKind::number_or_name:
        return check(NumberOrName{});
    case ValueKind::integer:
        return check(std::int64_t{});
    case ValueKind::boolean:
        return check(bool{});
    case ValueKind::text:
    case ValueKind::choice:
        return check(std::string{});
    case ValueKind::vector:
        return check(std::vector<double>{});
    case ValueKind::vectors:
        return check(std::vector<Vec3>{});
    case ValueKind::integers:
        return check(std::vector<std::int64_t>{});
    case ValueKind::texts:
        return check(std::vector<std::string>{});
    case ValueKind::table:
    case ValueKind::tables:
        return; // not read: their keys depend on this table
    }
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
        } else {
            check_kind(entry);
        }
    }
}

} // namespace hyoryu
