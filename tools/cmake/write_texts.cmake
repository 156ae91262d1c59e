# Manual pages and completions, asked of the program itself: cmake -DPROGRAM=... -DFOLDER=... -P
set(ENV{ASAN_OPTIONS} detect_leaks=0) # leaks are found by tests, not by a build

function(write_output file)
  execute_process(COMMAND ${PROGRAM} ${ARGN} OUTPUT_FILE ${FOLDER}/${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(MAKE_DIRECTORY ${FOLDER}/man ${FOLDER}/completions)
write_output(man/hyoryu.1 man)
file(READ ${FOLDER}/man/hyoryu.1 page)
string(REGEX MATCHALL "fBhyoryu[\\]-[a-z]+" entries "${page}")
foreach(entry IN LISTS entries)
  string(REGEX REPLACE ".*-" "" command ${entry})
  write_output(man/hyoryu-${command}.1 man ${command})
endforeach()
write_output(completions/hyoryu completions bash)
write_output(completions/_hyoryu completions zsh)
write_output(completions/hyoryu.fish completions fish)
