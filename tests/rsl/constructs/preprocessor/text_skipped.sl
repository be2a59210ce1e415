// text in #if 0: apostrophes, unbalanced quotes, comments and directives of other tools
#if 0
 It isn't RSL: 5" wide, "open to
   the next line, don't compile
 @@ ~ $ \ # what
  #if nested 'x
  #else
  #endif
 3" more
#else
surface text_skipped() { Ci = 0; }
#define TEXT_SKIPPED
#endif
  #ifndef TEXT_SKIPPED
     "one
  #endif
