// printf of every type
surface printing(string label = "spot") {
    if (s < 0) printf("%s: %f %c %p %s\n", label, s, Cs, P, "end");
    if (t < 0) printf("done 100%%\n");
    Ci = Cs;
}
