// SPDX-License-Identifier: MIT
// The table of keys: their declarations as one list, and the search in it.
#include "hyoryu/scene/parameter.hpp"

#include "keys_scene.hpp"

#include <fmt/format.h>

#include <map>

namespace hyoryu {

namespace {

/// A number as it is typed: "1e-6", not "1e-06".
std::string typed(double value)
{
    std::string text = fmt::format("{}", value);
    if (const auto at = text.find("e-0"); at != std::string::npos) {
        text.erase(at + 2, 1);
    }
    return text;
}
std::string typed(const std::integral auto& value)
{
    return fmt::format("{}", value); // also true and false
}
std::string typed(const Vec3& v)
{
    return fmt::format("[{:#}, {:#}, {:#}]", v.x(), v.y(), v.z());
}
/// Values that are empty by default; only the brackets of a list are printed for them.
std::string typed(const std::vector<std::string>& /*texts*/)
{
    return "[]";
}
template <class T>
std::string typed(const T& /*value*/)
{
    return {};
}

/// Visits keys; see `KeyWords`. Lists each once, with all alternatives.
class KeyTable : public KeyWords<KeyTable> {
public:
    static constexpr bool writes = false;

    /// Appends to `rows` the keys of the table whose keys begin with `prefix`.
    KeyTable(std::vector<Parameter>& rows, std::string prefix)
        : rows_(rows), prefix_(std::move(prefix))
    {
    }

    void key(const Parameter& rule, const auto& member, Default fallback)
    {
        add(rule, fallback ? *fallback : typed(member));
    }
    bool pick(const Parameter& rule, std::size_t index, Default fallback)
    {
        add(rule, fallback.value_or(rule.choices[index]));
        return true;
    }
    static void each_choice(std::size_t count, std::size_t /*chosen*/, auto&& what)
    {
        for (std::size_t k = 0; k < count; ++k) {
            what(k);
        }
    }
    void heading(std::string_view name, std::string_view meaning)
    {
        add(row(name, ValueKind::table, "", meaning), {});
    }
    template <class What, class... Context>
    void table(std::string_view name, std::string_view meaning, What&& what, Context&&... context)
    {
        heading(name, meaning);
        KeyTable inner(rows_, fmt::format("{}{}.", prefix_, name));
        if constexpr (is_optional<What>) {
            visit_keys(inner, what.emplace(), context...);
        } else {
            visit_keys(inner, what, context...);
        }
    }
    template <class T, class... Context>
    void tables(std::string_view name, std::string_view meaning, std::vector<T>& /*list*/,
                Context&&... context)
    {
        add(row(name, ValueKind::tables, "", meaning), {});
        KeyTable inner(rows_, fmt::format("{}{}[].", prefix_, name));
        T item;
        keys_of(inner, item, context...);
    }
    static bool applies(bool /*condition*/) { return true; }

private:
    void add(Parameter rule, std::string_view fallback)
    {
        rule.key = prefix_ + rule.key;
        rule.fallback = fallback == needed ? no_default : fallback;
        if (std::ranges::find(rows_, rule.key, &Parameter::key) == rows_.end()) {
            rows_.push_back(std::move(rule));
        }
    }

    std::vector<Parameter>& rows_;
    std::string prefix_;
};

std::vector<Parameter> all_parameters()
{
    std::vector<Parameter> rows;
    KeyTable keys(rows, {});
    Scene scene;
    keys_of(keys, scene);
    return rows;
}

std::map<std::string_view, const Parameter*> by_key()
{
    std::map<std::string_view, const Parameter*> result;
    for (const Parameter& parameter : parameters()) {
        result.emplace(parameter.key, &parameter);
    }
    return result;
}

} // namespace

std::span<const Parameter> parameters()
{
    static const std::vector<Parameter> all = all_parameters();
    return all;
}

const Parameter* find_parameter(std::string_view key)
{
    static const std::map<std::string_view, const Parameter*> index = by_key();
    const auto at = index.find(key);
    return at == index.end() ? nullptr : at->second;
}

} // namespace hyoryu
