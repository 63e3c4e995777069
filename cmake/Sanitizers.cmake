# -fsanitize for every target, with frame pointers and no recovery: the first finding ends the test.
target_compile_options(moire_flags INTERFACE -fsanitize=${MOIRE_SANITIZE} -fno-omit-frame-pointer
  -fno-sanitize-recover=all)
target_link_options(moire_flags INTERFACE -fsanitize=${MOIRE_SANITIZE})

# moire_quick_to_compile(TARGET): no optimisation of a target that does no numerical work. Under sanitizers the optimiser
# takes two thirds of the time that a file full of templates costs (g++ 12: 38 s against 12 s for a test of the program),
# and saves nothing when it runs.
function(moire_quick_to_compile target)
  target_compile_options(${target} PRIVATE -O0)
endfunction()
