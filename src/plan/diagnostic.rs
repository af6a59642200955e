#[derive(Debug)] pub struct Diagnostics;
