// SPDX-License-Identifier: MIT
// Reading a table of the case file as its keys are declared: every value is checked for type, unit
// and bounds, every mistake is noted with its place, and nothing is left unread.
#pragma once

#include "keys.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/scene.hpp"
#include "hyoryu/scene/toml_document.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hyoryu {

/// State shared by the tables of a case while it is read.
struct Reading {
    std::filesystem::path file;
    std::vector<std::string> lines;
    std::vector<std::string> overrides;
    int dimensions = 3;
    bool dimensions_known = true; // their number was not lost with a mistake
    double spacing = 0;           // of the particles; 0 where it was lost with a mistake [m]
    std::vector<Diagnostic> diagnostics;
    std::vector<Diagnostic> notices;  // warnings
    std::map<std::string, int> names; // of walls and bodies, and the line where each stands
    bool names_known = true;          // no name and no material was lost with a mistake
    std::size_t of_buildings = 0;     // diagnostics of the contents of building files

    /// Whether all walls but buildings are known, so that other places follow from them.
    bool walls_known() const { return diagnostics.size() == of_buildings; }
    /// Whether the buildings are known as well.
    bool places_known() const { return walls_known() && names_known; }

    /// Notes a mistake at a place of the file, or of that override. Without a hint the meaning of
    /// the key stands for one.
    void error(const Place& place, int override_number, std::string key, std::string what,
               std::string hint = {});
    /// Notes a warning, in the same way.
    void warn(const Place& place, std::string key, std::string what, std::string hint);
    /// A mistake at a value.
    void error(const TomlNode& node, std::string key, std::string what, std::string hint = {});
};

/// A value of the file, or an element of one, that is read by the rule of its key.
struct Asked {
    Reading& reading;
    const TomlNode& node;
    const Parameter& rule;
    std::string key; // full path

    /// Notes a mistake, and is false.
    bool refuse(std::string what, std::string hint = {}) const
    {
        reading.error(node, key, std::move(what), std::move(hint));
        return false;
    }
    /// "expected a text, found the number 3"
    bool refuse_kind(std::string_view expected) const;
};

// Each reads a member: false if the value is mistaken, which is noted.
bool read(const Asked& asked, double& member);
bool read(const Asked& asked, std::int64_t& member);
bool read(const Asked& asked, bool& member);
bool read(const Asked& asked, std::string& member);  // one of the choices, if there are some
bool read(const Asked& asked, NumberOrName& member); // a text that begins with a digit has a unit
bool read(const Asked& asked, Vec3& member);
bool read(const Asked& asked, Quat& member);

/// The elements of a list of the right length, else none.
const TomlArray* elements(const Asked& asked, std::string_view what);

/// The elements up to the first mistake; of texts all that are sound.
template <class T>
bool read(const Asked& asked, std::vector<T>& member)
{
    constexpr bool texts = std::same_as<T, std::string>;
    const TomlArray* items = elements(asked, texts                           ? "texts"
                                             : std::same_as<T, std::int64_t> ? "whole numbers"
                                             : std::same_as<T, Vec3>         ? "lists of 3 numbers"
                                                                             : "numbers");
    bool sound = items != nullptr;
    member.clear();
    for (std::size_t k = 0; items != nullptr && (sound || texts) && k < items->size(); ++k) {
        T value{};
        const Asked item{asked.reading, (*items)[k], asked.rule,
                         asked.key + '[' + std::to_string(k) + ']'};
        bool taken = read(item, value);
        if constexpr (texts) { // names of a set
            if (taken && !asked.rule.choices.empty() &&
                std::ranges::find(member, value) != member.end()) {
                taken = item.refuse("\"" + value + "\" is listed twice", "remove one of the two");
            }
        }
        if (taken) {
            member.push_back(value);
        } else {
            sound = false;
        }
    }
    return sound;
}
template <class T, std::size_t n>
bool read(const Asked& asked, std::array<T, n>& member)
{
    std::vector<T> values;
    const bool sound = read(asked, values);
    std::copy_n(values.begin(), std::min(n, values.size()), member.begin());
    return sound;
}
template <class T>
bool read(const Asked& asked, std::optional<T>& member)
{
    T value;
    const bool sound = read(asked, value);
    member = sound ? std::optional(value) : member;
    return sound;
}
template <std::integral T>
bool read(const Asked& asked, T& member)
{
    auto value = static_cast<std::int64_t>(member);
    const bool sound = read(asked, value);
    member = static_cast<T>(value);
    return sound;
}

/// One table of the file, or its absence, which leaves every member as it is; so does a mistake.
class TableReader : public KeyWords<TableReader> {
public:
    static constexpr bool writes = false;

    /// `path` is where the table stands ("body[2]"), `schema` its name in the table of keys
    /// ("body[]"), `number` which of its kind it is, from 1 on.
    TableReader(Reading& reading, const TomlNode* node, std::string path, std::string schema,
                std::size_t number = 1);

    bool present() const { return node_ != nullptr; }
    bool has(std::string_view key) const;
    /// The value of a key, or none.
    const TomlNode* find(std::string_view key) const;
    /// Whether a key is there and without mistake.
    bool sound(std::string_view key) const;
    /// Whether the value of one of the keys, or of any key so far, was refused: its consequences
    /// are unknown, and a further message would mislead.
    bool mistaken(std::initializer_list<std::string_view> keys) const;
    bool mistaken() const { return abandoned_ || !mistaken_.empty(); }
    /// Number of elements of a list that is sound.
    std::size_t count(std::string_view key) const;
    Place place() const { return node_ != nullptr ? node_->place : Place{}; }
    const std::string& name_of_table() const { return path_; }
    std::size_t number_of_table() const { return number_; }
    Reading& reading() const { return reading_; }

    // Visits keys; see `KeyWords`.

    void key(const Parameter& rule, auto& member, Default fallback)
    {
        const TomlNode* node = ask(rule.key, fallback);
        if (node != nullptr) {
            const bool is_sound = read({reading_, *node, rule, full(rule.key)}, member);
            (is_sound ? sound_ : mistaken_).push_back(rule.key);
        }
    }
    template <class T>
    void planar(std::string_view name, T& member, std::string_view unit, std::string_view meaning,
                Default fallback = {}, int shortest = 3)
    {
        vector(name, member, unit, meaning, fallback, shortest);
        if constexpr (std::same_as<T, Vec3>) {
            flatten(name, unit, member);
        } else if (member) {
            flatten(name, unit, *member);
        }
    }
    void direction(std::string_view name, Vec3& member, std::string_view meaning,
                   Default fallback = {});
    bool gives(std::string_view name) const { return has(name); }
    bool pick(const Parameter& rule, std::size_t& index, Default fallback);
    template <class What, class... Context>
    void table(std::string_view name, std::string_view /*meaning*/, What&& what,
               Context&&... context)
    {
        TableReader inner = inside(name);
        if constexpr (!is_optional<What>) {
            visit_keys(inner, what, context...);
        } else if (inner.present()) {
            visit_keys(inner, what.emplace(), context...);
        }
        inner.finish();
    }
    template <class T, class... Context>
    void tables(std::string_view name, std::string_view /*meaning*/, std::vector<T>& list,
                Context&&... context)
    {
        for (TableReader& inner : each_inside(name)) {
            T item;
            if constexpr (requires { item.place; }) {
                item.place = inner.place();
            }
            if constexpr (requires { item.table; }) {
                item.table = inner.name_of_table();
            }
            keys_of(inner, item, context...);
            inner.finish();
            list.push_back(std::move(item));
        }
    }
    template <class Rule, class... Arguments>
    void rule(Rule&& check, Arguments&&... arguments)
    {
        check(*this, arguments...);
    }

    /// Notes a mistake at the value of a key, or at the table if the key is not there.
    void error(std::string_view key, std::string what, std::string hint = {});
    /// The same at an element of a list.
    void error_at(std::string_view key, std::size_t index, std::string what, std::string hint = {});
    /// Notes a warning, in the same place.
    void warn(std::string_view key, std::string what, std::string hint);
    /// In two dimensions takes y away, and warns of a speed or an acceleration that had one.
    void flatten(std::string_view name, std::string_view unit, Vec3& vector);
    /// A key that must be there in this case although not in every one.
    void require(std::string_view key);
    /// After a mistake: stops reporting keys of this table as having no meaning.
    void abandon() { abandoned_ = true; }

    /// Notes every key that is unknown or was never read. Must be the last call.
    void finish();

private:
    const Parameter& parameter(std::string_view key) const;
    const TomlNode* ask(std::string_view key, Default fallback);
    TableReader inside(std::string_view key);
    std::vector<TableReader> each_inside(std::string_view key);
    std::string full(std::string_view key) const;

    void report_unknown(const TomlEntry& entry);
    void report_unused(const TomlEntry& entry);
    void check_kind(const TomlEntry& entry);

    Reading& reading_;
    const TomlNode* node_;
    std::string path_;
    std::string schema_;
    std::size_t number_;
    std::vector<std::string> asked_;
    std::vector<std::string> sound_;
    std::vector<std::string> mistaken_;
    std::string chosen_; // `shape = "box"`: why other keys have no meaning
    bool abandoned_ = false;
};

} // namespace hyoryu
