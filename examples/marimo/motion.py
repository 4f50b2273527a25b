import marimo

app = marimo.App()


@app.cell
def _():
    import marimo as mo
    from motion_widgets import BananaMachine

    machine = mo.ui.anywidget(BananaMachine(omega=0.8, samples=20000))
    machine
    return machine, mo


@app.cell
def _(machine, mo):
    mo.md(f"turn rate {machine.value['omega']} rad/s")
    return


@app.cell
def _(machine, mo):
    mo.ui.button(label="Hard arc", on_click=lambda _: setattr(machine, "preset", "hard"))
    return


if __name__ == "__main__":
    app.run()
