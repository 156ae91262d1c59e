// SPDX-License-Identifier: MIT
#include "errors.hpp"

#include "options.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/name.hpp"
#include "hyoryu/scene/formula.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <new>
#include <system_error>

namespace hyoryu {

Meaning meaning_of(const std::exception_ptr& error)
{
    try {
        std::rethrow_exception(error);
    } catch (const CaseError& e) {
        return {e.what(), exit_code::input};
    } catch (const RoomError& e) {
        return {fmt::format("error: {}", e.what()), exit_code::numbers};
    } catch (const NumericalError& e) {
        return {fmt::format("error: the simulation became unstable: {}", e.what()),
                exit_code::numbers};
    } catch (const IoError& e) {
        return {fmt::format("error: {}", e.what()), exit_code::io};
    } catch (const std::system_error& e) {
        if (e.code() == std::errc::resource_unavailable_try_again) {
            return {
                "error: a thread cannot be started: the limit on memory or processes is reached",
                exit_code::io};
        } // else files and streams of the standard library
        return {fmt::format("error: {}", e.what()), exit_code::io};
    } catch (const std::bad_alloc&) {
        return {out_of_memory, exit_code::io};
    } catch (const FormulaError& e) {
        return {fmt::format("error: {}", e.what()), exit_code::input};
    }
}

int tell_error(const std::exception_ptr& error, const std::string& who)
{
    const Meaning told = meaning_of(error); // fmt::print would throw
    std::fputs((who + printable(told.message) + "\n").c_str(), stderr);
    return told.code;
}

} // namespace hyoryu
