/* tests/runtime/ri/handlers.c RIB PICTURE: a program's own error handler and procedural, comments, places
 * in other spaces, and a second context between the calls of the first. It ends with the number of the
 * line that found a fault.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ri.h"

#define CHECK(x) if (!(x)) exit(__LINE__ % 250 + 1)

static int errors, last_code, last_severity, freed;
static char last_message[1000];

RtVoid my_handler(RtInt code, RtInt severity, char *message)
{
    if (severity == RIE_INFO) return;
    errors++;
    last_code = code;
    last_severity = severity;
    strncpy(last_message, message, sizeof last_message - 1);
}

typedef struct {
    int depth;
    RtFloat size;
} Tree;

RtVoid free_tree(RtPointer data)
{
    freed++;
    free(data);
}

/* A box of spheres, which becomes smaller ones. */
RtVoid grow(RtPointer data, RtFloat detail)
{
    static RtBound bound = {-1, 1, -1, 1, -1, 1};
    Tree *tree = (Tree *)data, *part;
    int i;

    CHECK(detail > 0);
    RiSphere(tree->size, -tree->size, tree->size, 360.0, RI_NULL);
    if (tree->depth == 0) return;
    for (i = -1; i <= 1; i += 2) {
        part = (Tree *)malloc(sizeof(Tree));
        part->depth = tree->depth - 1;
        part->size = tree->size / 2;
        RiTransformBegin();
        RiTranslate(2 * i * tree->size, tree->size / 2, 0.0);
        RiProcedural((RtPointer)part, bound, grow, free_tree);
        RiTransformEnd();
    }
}

/* Its world ends while the first one's is open. */
void other_context(char *rib)
{
    static RtString form[] = {"binary"};
    RtContextHandle first = RiGetContext(), second;

    CHECK(first);
    RiBegin(rib);
    second = RiGetContext();
    CHECK(second && second != first);
    RiErrorHandler(my_handler);
    RiOption("rib", "format", (RtPointer)form, RI_NULL);
    RiContext(first);
    RiSides((RtInt)2);
    RiContext(second);
    RiWorldBegin();
    RiDisk(0.0, 1.0, 360.0, RI_NULL);
    RiWorldEnd();
    RiEnd();
    CHECK(!RiGetContext());
    errors = 0;
    RiSides((RtInt)1); /* nobody hears it */
    CHECK(RiLastError == RIE_NOTSTARTED && errors == 1 && last_code == RIE_NOTSTARTED);
    RiContext(second);
    CHECK(RiLastError == RIE_BADHANDLE && !RiGetContext());
    RiContext(first);
    CHECK(RiGetContext() == first);
}

void wrong_calls(int renders)
{
    static RtFloat nothing = 0;

    errors = 0;
    RiSurface("matte", "no such token", (RtPointer)&nothing, RI_NULL);
    CHECK(errors == 1 && last_code == RIE_BADTOKEN && RiLastError == RIE_BADTOKEN);
    CHECK(strstr(last_message, "no such token"));
    RiObjectInstance((RtObjectHandle)(char *)4711);
    CHECK(errors == 2 && last_code == RIE_BADHANDLE);
    RiDeclare("x", "varying cheese");
    CHECK(errors == 3 && last_code == RIE_SYNTAX);
    RiPatch("cubic", RI_P, (RtPointer)&nothing, RI_NULL);
    CHECK(errors == 4 && last_code == RIE_BADTOKEN);
    if (!renders) return; /* who writes RIB judges no order */
    RiFormat((RtInt)10, (RtInt)10, 1.0);
    CHECK(errors == 5 && last_code == RIE_NOTOPTIONS);
    RiTransformEnd();
    CHECK(errors == 6 && last_code == RIE_NESTING);
    RiSurface("no_such_shader", RI_NULL);
    CHECK(errors == 7 && last_code == RIE_NOSHADER);
}

int near(RtFloat a, RtFloat b)
{
    return fabs(a - b) < 1e-5;
}

void spaces()
{
    static RtPoint p[2] = {{0, 0, 0}, {1, 2, 3}};
    RtPoint *found;

    found = RiTransformPoints("world", RI_CAMERA, (RtInt)2, p);
    CHECK(found == p);
    CHECK(near(p[0][0], 0) && near(p[0][1], 0) && near(p[0][2], 5));
    CHECK(near(p[1][0], 1) && near(p[1][1], 2) && near(p[1][2], 8));
    CHECK(!RiTransformPoints("nowhere", RI_CAMERA, (RtInt)2, p));
    CHECK(!RiTransformPoints(RI_NULL, RI_NULL, (RtInt)2, p));
}

int main(int argc, char **argv)
{
    static RtFloat fov = 45;
    char name[1000], other[1000];
    Tree *tree;
    int renders;

    if (argc != 3) exit(2);
    renders = !argv[1][0];
    sprintf(name, "%s1.png", argv[2]);
    sprintf(other, "%s.other.rib", argv[2]);
    RiErrorHandler(my_handler);
    RiEnd();
    CHECK(RiLastError == RIE_NOTSTARTED && errors == 1);
    RiBegin(argv[1][0] ? argv[1] : RI_NULL);
    RiArchiveRecord(RI_STRUCTURE, "Scene %s number %d", "tree", 3);
    RiArchiveRecord(RI_COMMENT, "half is %.1f", .5);
    RiDisplay(name, RI_FILE, RI_RGBA, RI_NULL);
    RiFormat((RtInt)48, (RtInt)48, 1.0);
    RiPixelSamples(1.0, 1.0);
    RiProjection("perspective", "fov", (RtPointer)&fov, RI_NULL);
    RiTranslate(0.0, 0.0, 5.0);
    RiWorldBegin();
    RiLightSource("distantlight", RI_NULL);
    wrong_calls(renders);
    spaces();
    other_context(other);
    RiSurface("matte", RI_NULL);
    tree = (Tree *)malloc(sizeof(Tree));
    tree->depth = 2;
    tree->size = .6;
    RiProcedural((RtPointer)tree, RI_NULL, grow, free_tree);
    CHECK(freed == 7);
    RiWorldEnd();
    RiEnd();
    CHECK(!RiGetContext());
    return 0;
}
