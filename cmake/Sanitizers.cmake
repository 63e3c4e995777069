# -fsanitize for every target, with frame pointers and no recovery: the first finding ends the test.
target_compile_options(moire_flags INTERFACE -fsanitize=${MOIRE_SANITIZE} -fno-omit-frame-pointer
  -fno-sanitize-recover=all)
target_link_options(moire_flags INTERFACE -fsanitize=${MOIRE_SANITIZE})
