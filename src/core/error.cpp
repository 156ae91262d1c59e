// SPDX-License-Identifier: MIT
#include "hyoryu/core/error.hpp"

#include "hyoryu/core/name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <tuple>

namespace hyoryu {

namespace {

// Lists the mistakes in the order of the file; of many, the first ones and the number of the
// others.
std::vector<Diagnostic> sorted(std::vector<Diagnostic> diagnostics)
{
    constexpr std::size_t most = 100;
    std::stable_sort(diagnostics.begin(), diagnostics.end(), [](const auto& a, const auto& b) {
        return std::tie(a.line, a.column) < std::tie(b.line, b.column);
    });
    if (diagnostics.size() > most) {
        const std::size_t more = diagnostics.size() - most;
        diagnostics.resize(most);
        const Diagnostic& last = diagnostics.back();
        diagnostics.push_back({.file = last.file,
                               .line = last.line,
                               .column = last.column,
                               .what = fmt::format("and {} more errors", more)});
    }
    return diagnostics;
}

std::string joined(const std::vector<Diagnostic>& diagnostics)
{
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics) {
        text += text.empty() ? "" : "\n";
        text += to_string(diagnostic);
    }
    return text;
}

std::string unguarded_text(const Diagnostic& d)
{
    std::string text;
    if (!d.file.empty()) {
        text += d.file + ":";
        if (d.line > 0) {
            text += fmt::format("{}:{}:", d.line, d.column);
        }
        text += ' ';
    }
    text += d.severity == Diagnostic::Severity::error ? "error: " : "warning: ";
    if (!d.key.empty()) {
        text += "`" + d.key + "`: ";
    }
    text += d.what;
    if (!d.source.empty() && d.line > 0) {
        const auto indent = static_cast<std::size_t>(std::max(d.column - 1, 0));
        const auto carets = static_cast<std::size_t>(std::max(d.length, 1));
        text += fmt::format("\n{:>5} | {}\n      | {}{}", d.line, d.source,
                            std::string(indent, ' '), std::string(carets, '^'));
    }
    if (!d.hint.empty()) {
        text += "\n  hint: " + d.hint;
    }
    return text;
}

} // namespace

// Messages quote user input, which must not send control characters to a terminal.
std::string to_string(const Diagnostic& diagnostic)
{
    return printable(unguarded_text(diagnostic));
}

CaseError::CaseError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(joined(sorted(diagnostics))), diagnostics_(sorted(std::move(diagnostics)))
{
}

CaseError::CaseError(std::string what, std::string hint)
    : CaseError(
          std::vector<Diagnostic>{Diagnostic{.what = std::move(what), .hint = std::move(hint)}})
{
}

NumericalError::NumericalError(const Where& w)
    : NumericalError(w, fmt::format("step {}, t = {:.6g} s: {}: {}: {}", w.step, w.time, w.who,
                                    w.field, w.cause))
{
}

NumericalError::NumericalError(const Where& w, const std::string& text)
    : std::runtime_error(text), where(w)
{
}

RoomError::RoomError(std::int64_t step, double time, std::int64_t held, std::int64_t most)
    : NumericalError({.step = step, .time = time, .who = {}, .field = {}, .cause = {}},
                     fmt::format("step {}, t = {:.6g} s: the run holds {} fluid particles, more "
                                 "than the {} that `particles.most` allows",
                                 step, time, held, most))
{
}

#ifndef NDEBUG
void fail_expectation(const std::source_location& place)
{
    std::fprintf(stderr, "%s:%u: broken expectation in %s\n", place.file_name(), place.line(),
                 place.function_name());
    std::abort();
}
#endif

} // namespace hyoryu
