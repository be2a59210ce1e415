// bytes that are no ASCII: in comments, strings, and as no-break spaces
surface text_latin1(string who = "Grüsse";) { // über
    float a = 1;
    if (who != "ü") Ci = a * Cs;
}
