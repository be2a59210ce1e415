float step_of(float x) { return x; }
surface x(float n = 3;) {
    float i = 0, sum = 0;
    while (i < n) sum += 1;
    while (i < n) { sum += 1; i += 1; }
    while (i < n) { sum += 1; if (sum > 4) break; }
    while (random() < 0.5) sum += 1;
    while (step_of(i) > 0) sum += 1;
    while (0) sum += 1;
    while (1) sum += 1;
    for (i = 0; i < n; sum += 1) sum += 2;
    for (i = 0; i < n; i += 1) sum += 2;
    void next() { extern float i; i += 1; }
    while (i < n) next();
    for (i = 0; i < 10; i -= 1) sum += 2;
    for (i = 9; i >= 0; i = i + 1) sum += 2;
    for (i = 9; i >= 0; i -= 1) sum += 2;
    for (i = 0; i < 10; i -= 1) { sum += 2; i += 3; }
    for (i = 0; i < 10; i -= 1) if (sum > 4) break;
    for (i = 0; i < 10; i -= n) sum += 2;
    Ci = sum;
}
//! 4:5 warning RSL_ENDLESS_LOOP cannot end
//! 10:5 warning RSL_ENDLESS_LOOP cannot end
//! 11:5 warning RSL_ENDLESS_LOOP cannot end
//! 15:5 warning RSL_LOOP_AWAY leads away
//! 16:5 warning RSL_LOOP_AWAY leads away
