// runtime/programs/play/window/input.cpp: what ImGui reads of the keyboard and the mouse.
#include "runtime/programs/play/window/input.h"

#include <SDL.h>
#include <imgui.h>

#include <array>
#include <iterator>
#include <utility>

#include "runtime/programs/play/window/libsdl_p.h"

namespace kinora::play {

namespace {

struct KeyRow {
    ImGuiKey key;
    SDL_Scancode code;
};
constexpr KeyRow kKeys[] = {
    {ImGuiKey_Tab, SDL_SCANCODE_TAB},           {ImGuiKey_LeftArrow, SDL_SCANCODE_LEFT},
    {ImGuiKey_RightArrow, SDL_SCANCODE_RIGHT},  {ImGuiKey_UpArrow, SDL_SCANCODE_UP},
    {ImGuiKey_DownArrow, SDL_SCANCODE_DOWN},    {ImGuiKey_PageUp, SDL_SCANCODE_PAGEUP},
    {ImGuiKey_PageDown, SDL_SCANCODE_PAGEDOWN}, {ImGuiKey_Home, SDL_SCANCODE_HOME},
    {ImGuiKey_End, SDL_SCANCODE_END},           {ImGuiKey_Insert, SDL_SCANCODE_INSERT},
    {ImGuiKey_Delete, SDL_SCANCODE_DELETE},     {ImGuiKey_Backspace, SDL_SCANCODE_BACKSPACE},
    {ImGuiKey_Space, SDL_SCANCODE_SPACE},       {ImGuiKey_Enter, SDL_SCANCODE_RETURN},
    {ImGuiKey_Escape, SDL_SCANCODE_ESCAPE},     {ImGuiKey_KeyPadEnter, SDL_SCANCODE_KP_ENTER},
};

// Letters by what is printed on them, wherever they lie on this keyboard: kept at codes above
// SDL's.
struct LetterRow {
    ImGuiKey key;
    SDL_Keycode letter;
};
constexpr LetterRow kLetters[] = {{ImGuiKey_A, SDLK_a}, {ImGuiKey_C, SDLK_c}, {ImGuiKey_V, SDLK_v},
                                  {ImGuiKey_X, SDLK_x}, {ImGuiKey_Y, SDLK_y}, {ImGuiKey_Z, SDLK_z}};
constexpr int kLetterBase = 500;
static_assert(kLetterBase + 6 < 512, "ImGui has 512 keys");

std::array<SDL_Cursor*, ImGuiMouseCursor_COUNT> g_pointers{};

const char* clipboard_text(void*) {
    static char* text = nullptr;
    sdl().SDL_free(text);
    text = sdl().SDL_GetClipboardText();
    return text;
}

void set_clipboard_text(void*, const char* text) {
    sdl().SDL_SetClipboardText(text);
}

void take_key(const SDL_KeyboardEvent& event) {
    ImGuiIO& io = ImGui::GetIO();
    const bool down = event.type == SDL_KEYDOWN;
    const int code = event.keysym.scancode;
    if (code >= 0 && code < kLetterBase) io.KeysDown[code] = down;
    for (size_t i = 0; i < std::size(kLetters); ++i)
        if (event.keysym.sym == kLetters[i].letter)
            io.KeysDown[kLetterBase + static_cast<int>(i)] = down;
    const unsigned modifiers = event.keysym.mod;
    io.KeyShift = modifiers & KMOD_SHIFT;
    io.KeyCtrl = modifiers & KMOD_CTRL;
    io.KeyAlt = modifiers & KMOD_ALT;
    io.KeySuper = modifiers & KMOD_GUI;
}

void take_button(const SDL_MouseButtonEvent& event) {
    constexpr int kButtons[] = {-1, 0, 2, 1};  // SDL: left 1, middle 2, right 3
    if (event.button < 1 || event.button > 3) return;
    ImGui::GetIO().MouseDown[kButtons[event.button]] = event.type == SDL_MOUSEBUTTONDOWN;
}

}  // namespace

void connect_input() {
    ImGuiIO& io = ImGui::GetIO();
    for (const KeyRow& row : kKeys) io.KeyMap[row.key] = row.code;
    for (size_t i = 0; i < std::size(kLetters); ++i)
        io.KeyMap[kLetters[i].key] = kLetterBase + static_cast<int>(i);
    io.GetClipboardTextFn = clipboard_text;
    io.SetClipboardTextFn = set_clipboard_text;
    io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
    io.ConfigInputTextCursorBlink = false;  // a window at rest draws nothing
    g_pointers[ImGuiMouseCursor_Arrow] = sdl().SDL_CreateSystemCursor(SDL_SYSTEM_CURSOR_ARROW);
    g_pointers[ImGuiMouseCursor_TextInput] = sdl().SDL_CreateSystemCursor(SDL_SYSTEM_CURSOR_IBEAM);
    g_pointers[ImGuiMouseCursor_ResizeAll] =
        sdl().SDL_CreateSystemCursor(SDL_SYSTEM_CURSOR_SIZEALL);
    g_pointers[ImGuiMouseCursor_ResizeNS] = sdl().SDL_CreateSystemCursor(SDL_SYSTEM_CURSOR_SIZENS);
    g_pointers[ImGuiMouseCursor_ResizeEW] = sdl().SDL_CreateSystemCursor(SDL_SYSTEM_CURSOR_SIZEWE);
    g_pointers[ImGuiMouseCursor_Hand] = sdl().SDL_CreateSystemCursor(SDL_SYSTEM_CURSOR_HAND);
    sdl().SDL_StartTextInput();
}

void take_event(const SDL_Event& event, float scale) {
    ImGuiIO& io = ImGui::GetIO();
    switch (event.type) {
        case SDL_MOUSEMOTION:
            io.MousePos = {static_cast<float>(event.motion.x) * scale,
                           static_cast<float>(event.motion.y) * scale};
            break;
        case SDL_MOUSEWHEEL:
            io.MouseWheel += event.wheel.preciseY;
            io.MouseWheelH -= event.wheel.preciseX;
            break;
        case SDL_MOUSEBUTTONDOWN:
        case SDL_MOUSEBUTTONUP:
            io.MousePos = {static_cast<float>(event.button.x) * scale,
                           static_cast<float>(event.button.y) * scale};
            take_button(event.button);
            break;
        case SDL_KEYDOWN:
        case SDL_KEYUP:
            take_key(event.key);
            break;
        case SDL_TEXTINPUT:
            io.AddInputCharactersUTF8(event.text.text);
            break;
        case SDL_WINDOWEVENT:
            if (event.window.event == SDL_WINDOWEVENT_LEAVE) io.MousePos = {-FLT_MAX, -FLT_MAX};
            if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST) io.AddFocusEvent(false);
            break;
        default:
            break;
    }
}

dvec3 steering() {
    const uint8_t* down = sdl().SDL_GetKeyboardState(nullptr);
    const auto axis = [&](SDL_Scancode more, SDL_Scancode less) {
        return static_cast<double>(down[more]) - static_cast<double>(down[less]);
    };
    return {axis(SDL_SCANCODE_D, SDL_SCANCODE_A), axis(SDL_SCANCODE_E, SDL_SCANCODE_Q),
            axis(SDL_SCANCODE_W, SDL_SCANCODE_S)};
}

void show_pointer() {
    static int shown = ImGuiMouseCursor_Arrow;
    const int wanted = ImGui::GetMouseCursor();
    if (wanted == shown || wanted < 0) return;
    shown = wanted;
    SDL_Cursor* pointer = g_pointers[static_cast<size_t>(wanted)];
    sdl().SDL_SetCursor(pointer ? pointer : g_pointers[ImGuiMouseCursor_Arrow]);
}

void free_pointers() {
    for (SDL_Cursor*& pointer : g_pointers)
        if (pointer) sdl().SDL_FreeCursor(std::exchange(pointer, nullptr));
}

}  // namespace kinora::play
