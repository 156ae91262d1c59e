// SPDX-License-Identifier: MIT
// A scene as a case file with every default written out, in numbers that read back bit by bit.
#include "hyoryu/scene/case_file.hpp"

#include "keys_scene.hpp"

#include <fmt/format.h>

namespace hyoryu {

namespace {

/// The shortest text that reads back as the same double, with a point or exponent so that TOML
/// takes it for a number with a sign of zero.
std::string toml(double value)
{
    std::string text = fmt::format("{}", value);
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string toml(const std::string& text)
{
    std::string quoted = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            quoted += '\\';
            quoted += c;
        } else if (code < ' ' || code == 127) {
            quoted += fmt::format("\\u{:04X}", static_cast<int>(code));
        } else {
            quoted += c;
        }
    }
    return quoted + '"';
}

std::string toml(const NumberOrName& value)
{
    return value.number ? toml(*value.number) : toml(value.name);
}

std::string toml(const Vec3& v)
{
    return fmt::format("[{}, {}, {}]", toml(v.x()), toml(v.y()), toml(v.z()));
}

std::string toml(const Quat& q)
{
    return fmt::format("[{}, {}, {}, {}]", toml(q.w()), toml(q.x()), toml(q.y()), toml(q.z()));
}

std::string toml(const std::integral auto& value)
{
    return fmt::format("{}", value); // also true and false
}

template <class List>
std::string list(const List& values, std::string_view separator = ", ")
{
    std::string text;
    for (const auto& value : values) {
        text += fmt::format("{}{}", text.empty() ? "" : separator, toml(value));
    }
    return text;
}

template <class T>
std::string toml(const std::vector<T>& values)
{
    return fmt::format("[{}]", list(values));
}

std::string toml(const std::vector<Vec3>& places)
{
    return fmt::format("[\n  {}]", list(places, ",\n  "));
}

template <class T, std::size_t n>
std::string toml(const std::array<T, n>& values)
{
    return fmt::format("[{}]", list(values));
}

/// Visits keys; see `KeyWords`. Writes each with its value, but none whose optional is empty.
class KeyWriter : public KeyWords<KeyWriter> {
public:
    static constexpr bool writes = true;

    /// Appends the keys of the table at `path` to `text`.
    KeyWriter(std::string& text, std::string path) : text_(text), path_(std::move(path)) {}

    template <class T>
    void key(const Parameter& rule, const T& member, Default /*fallback*/)
    {
        if constexpr (!is_optional<T>) {
            text_ += fmt::format("{} = {}\n", rule.key, toml(member));
        } else if (member) {
            key(rule, *member, {});
        }
    }
    bool pick(const Parameter& rule, std::size_t index, Default /*fallback*/)
    {
        key(rule, std::string(rule.choices[index]), {});
        return true;
    }
    template <class What, class... Context>
    void table(std::string_view name, std::string_view /*meaning*/, const What& what,
               Context&&... context)
    {
        if constexpr (is_optional<What>) {
            if (what) {
                table(name, {}, *what, context...);
            }
        } else {
            text_ += path_.empty() ? "\n" : "";
            const std::string path = path_ + std::string(name);
            text_ += fmt::format("[{}]\n", path);
            KeyWriter inner(text_, path + ".");
            visit_keys(inner, what, context...);
        }
    }
    void effect(std::string_view name, std::string_view meaning, const auto& what)
    {
        text_ += "\n";
        table(name, meaning, what);
    }
    template <class T, class... Context>
    void tables(std::string_view name, std::string_view /*meaning*/, const std::vector<T>& list,
                Context&&... context)
    {
        const std::string path = path_ + std::string(name);
        for (const T& item : list) {
            text_ += fmt::format("\n[[{}]]\n", path);
            KeyWriter inner(text_, path + ".");
            keys_of(inner, item, context...);
        }
    }
    static void select(const auto& /*value*/, std::size_t /*index*/) {}
    static bool shows(bool condition) { return condition; }

private:
    std::string& text_;
    std::string path_;
};

} // namespace

std::string to_toml(const Scene& scene)
{
    std::string text;
    KeyWriter keys(text, {});
    keys_of(keys, scene);
    return text;
}

} // namespace hyoryu
