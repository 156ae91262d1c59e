// SPDX-License-Identifier: MIT
// Feeds one fuzz target without libFuzzer: every file of a corpus, then seeded mutations of them.
//
// Usage: fuzz_TARGET CORPUS_FOLDER [MUTATIONS [SEED]]. An input that crashes the target, or keeps
// it busy for too long, is left in the file `crash-input` of the current folder.
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <sys/time.h>
#include <unistd.h>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

// Seconds for one input: of the processor, and on the clock, which runs on while other processes
// have the cores.
constexpr long most_work = 20;
constexpr unsigned longest = 120;
constexpr std::size_t largest = std::size_t{1} << 16;

// What number and text readers stumble over.
constexpr std::array<std::string_view, 27> tokens{
    "0",      "-1",         "1e308",    "-1e308",
    "1e-308", "nan",        "inf",      "99999999999999999999",
    "1e9",    "-0.0",       "1e-12",    "2147483648",
    "[",      "]",          "{",        "}",
    "\"",     "=",          ".",        ",",
    "\n",     "[[wall]]\n", "((((((((", "\\u0000",
    "-",      "/",          "\xff"};

// The one input that a signal handler must be able to reach.
const std::string* present = nullptr;

void keep_input(int signal)
{
    const int file = ::open("crash-input", O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file >= 0 && ::write(file, present->data(), present->size()) >= 0) {
        ::close(file);
    }
    constexpr std::string_view message = "a signal ended the target; see crash-input\n";
    [[maybe_unused]] const auto told = ::write(STDERR_FILENO, message.data(), message.size());
    ::_exit(128 + signal);
}

// SIGPROF after so much time of the processor [s]; 0: none.
void limit_work(long seconds)
{
    const itimerval limit{{0, 0}, {seconds, 0}};
    ::setitimer(ITIMER_PROF, &limit, nullptr);
}

void feed(const std::string& input)
{
    present = &input;
    limit_work(most_work);
    ::alarm(longest);
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
    ::alarm(0);
    limit_work(0);
}

class Mutator {
public:
    Mutator(std::span<const std::string> corpus, unsigned seed) : corpus_(corpus), dice_(seed) {}

    std::string next()
    {
        std::string text = corpus_[below(corpus_.size())];
        for (std::size_t k = 0, n = 1 + below(4); k < n; ++k) {
            change(text);
        }
        text.resize(std::min(text.size(), largest));
        return text;
    }

private:
    /// Not a distribution of the standard library: those differ from one to the other.
    std::size_t below(std::size_t n) { return n == 0 ? 0 : dice_() % n; }

    void change(std::string& text)
    {
        const std::size_t place = below(text.size() + 1);
        const std::size_t length = below(std::min<std::size_t>(text.size() - place, 64) + 1);
        switch (below(7)) {
        case 0:
            if (place < text.size()) {
                text[place] = static_cast<char>(text[place] ^ (1 << below(8)));
            }
            return;
        case 1:
            text.erase(place, length);
            return;
        case 2:
            text.insert(place, text.substr(place, length));
            return;
        case 3:
            text.insert(place, tokens[below(tokens.size())]);
            return;
        case 4:
            return put_number(text, place);
        case 5: {
            const std::string& other = corpus_[below(corpus_.size())];
            const std::size_t first = below(other.size() + 1);
            text.insert(place, other.substr(first, below(256)));
            return;
        }
        default:
            text.resize(place);
        }
    }

    /// Another number in the place of the first one behind `place`.
    void put_number(std::string& text, std::size_t place)
    {
        constexpr const char* digits = "0123456789.e-";
        const std::size_t begin = text.find_first_of("0123456789", place);
        if (begin != std::string::npos) {
            const std::size_t end = std::min(text.find_first_not_of(digits, begin), text.size());
            text.replace(begin, end - begin, tokens[below(12)]);
        }
    }

    std::span<const std::string> corpus_;
    std::mt19937 dice_;
};

std::vector<std::string> read_corpus(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    std::vector<std::string> corpus;
    for (const auto& file : files) {
        std::ifstream stream(file, std::ios::binary);
        corpus.emplace_back(std::istreambuf_iterator<char>(stream),
                            std::istreambuf_iterator<char>());
    }
    return corpus;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc < 2) {
        std::fprintf(stderr, "usage: %s CORPUS_FOLDER [MUTATIONS [SEED]]\n", argv[0]);
        return 2;
    }
    for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL, SIGALRM, SIGPROF}) {
        std::signal(signal, keep_input);
    }
    const std::vector<std::string> corpus = read_corpus(argv[1]);
    if (corpus.empty()) {
        std::fprintf(stderr, "%s holds no input\n", argv[1]);
        return 2;
    }
    for (const std::string& input : corpus) {
        feed(input);
    }
    const long mutations = argc > 2 ? std::atol(argv[2]) : 0;
    Mutator mutator(corpus, argc > 3 ? static_cast<unsigned>(std::atol(argv[3])) : 1);
    for (long k = 0; k < mutations; ++k) {
        feed(mutator.next());
    }
    std::printf("%zu inputs and %ld mutations of them\n", corpus.size(), mutations);
    return 0;
}
