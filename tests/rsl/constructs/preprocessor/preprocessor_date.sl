// __FILE__ __LINE__ __DATE__ __TIME__
surface preprocessor_date() {
    printf("%s:%d of %s " __TIME__ "\n", __FILE__, __LINE__, __DATE__);
    Ci = __LINE__;
}
