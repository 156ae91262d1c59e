// SPDX-License-Identifier: MIT
// The table of keys as a JSON Schema, in the draft-04 subset that editors of TOML know.
#include "hyoryu/scene/parameter.hpp"

#include "hyoryu/core/name.hpp"
#include "keys.hpp"

#include <fmt/format.h>

namespace hyoryu {

namespace {

std::string json_text(std::string_view text)
{
    return '"' + replaced(text, {{'"', "\\\""}, {'\\', "\\\\"}}) + '"';
}

/// The schema of one number: a text with a unit is a number too.
std::string number_schema(const Parameter& parameter)
{
    std::string schema = "\"type\": \"number\"";
    constexpr double unbounded = 1e299;
    if (parameter.minimum > -unbounded) {
        schema += fmt::format(", \"minimum\": {}", parameter.minimum);
        schema += parameter.minimum_excluded ? ", \"exclusiveMinimum\": true" : "";
    }
    if (parameter.maximum < unbounded) {
        schema += fmt::format(", \"maximum\": {}", parameter.maximum);
    }
    return parameter.unit.empty()
               ? schema
               : fmt::format("\"anyOf\": [{{{}}}, {{\"type\": \"string\"}}]", schema);
}

std::string integer_schema(const Parameter& parameter)
{
    std::string schema = number_schema(parameter);
    const std::string_view number = "\"number\"";
    schema.replace(schema.find(number), number.size(), "\"integer\"");
    return schema;
}

std::string text_schema(const Parameter& parameter)
{
    std::string choices;
    for (const std::string_view choice : parameter.choices) {
        choices += (choices.empty() ? "" : ", ") + json_text(choice);
    }
    return choices.empty() ? "\"type\": \"string\"" : fmt::format("\"enum\": [{}]", choices);
}

std::string list_schema(const Parameter& parameter, const std::string& items)
{
    return fmt::format("\"type\": \"array\", \"minItems\": {}, \"maxItems\": {}, \"items\": {{{}}}",
                       parameter.shortest, parameter.longest, items);
}

/// The schema of the table whose keys begin with `prefix`. Tables nest a few deep.
std::string object_schema(std::string_view prefix)
{
    std::string properties;
    std::string needed;
    const auto value_schema = [](const Parameter& parameter) -> std::string {
        switch (parameter.kind) {
        case ValueKind::number:
            return number_schema(parameter);
        case ValueKind::number_or_name:
            return fmt::format("\"anyOf\": [{{{}}}, {{\"type\": \"string\"}}]",
                               number_schema({.key = {}, .kind = ValueKind::number}));
        case ValueKind::integer:
            return integer_schema(parameter);
        case ValueKind::boolean:
            return "\"type\": \"boolean\"";
        case ValueKind::text:
        case ValueKind::choice:
            return text_schema(parameter);
        case ValueKind::vector:
            return list_schema(parameter, number_schema(parameter));
        case ValueKind::vectors:
            return list_schema(parameter, fmt::format("\"type\": \"array\", \"minItems\": 3, "
                                                      "\"maxItems\": 3, \"items\": {{{}}}",
                                                      number_schema(parameter)));
        case ValueKind::integers:
            return list_schema(parameter, integer_schema(parameter));
        case ValueKind::texts:
            return list_schema(parameter, text_schema(parameter)) +
                   (parameter.choices.empty() ? "" : ", \"uniqueItems\": true");
        case ValueKind::table:
            return object_schema(fmt::format("{}.", parameter.key));
        case ValueKind::tables:
            return fmt::format("\"type\": \"array\", \"items\": {{{}}}",
                               object_schema(fmt::format("{}[].", parameter.key)));
        }
        return {};
    };
    for (const Parameter& parameter : parameters()) {
        if (!parameter.key.starts_with(prefix)) {
            continue;
        }
        const std::string_view name = std::string_view(parameter.key).substr(prefix.size());
        if (name.find('.') != std::string_view::npos) {
            continue;
        }
        properties +=
            fmt::format("{}\n{}: {{\"description\": {}, {}}}", properties.empty() ? "" : ",",
                        json_text(name), json_text(parameter.meaning), value_schema(parameter));
        if (parameter.fallback == required) {
            needed += (needed.empty() ? "" : ", ") + json_text(name);
        }
    }
    const std::string requires_text =
        needed.empty() ? "" : fmt::format(", \"required\": [{}]", needed);
    return fmt::format(
        "\"type\": \"object\", \"additionalProperties\": false{}, \"properties\": {{{}}}",
        requires_text, properties);
}

} // namespace

std::string json_schema()
{
    return fmt::format("{{\"$schema\": \"http://json-schema.org/draft-04/schema#\", "
                       "\"title\": \"Hyoryu case file\", {}}}\n",
                       object_schema(""));
}

} // namespace hyoryu
